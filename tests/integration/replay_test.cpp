// What was written down of a search over the real bus gives it back: the log of the bus the table
// that the executive held, and each worker's journal its choices.

#include <gtest/gtest.h>

#include <list>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

using nlohmann::json;

json Replay(const std::string& folder, const std::string& what, const std::string& file) {
  const std::string out = file + ".json";
  Process replay("prospect-bus", {"rebuild-" + what, file, "--json", out}, folder + "/replay.log");
  EXPECT_EQ(replay.Wait(30000), 0) << ReadText(folder + "/replay.log");
  return json::parse(ReadText(out));
}

TEST(Replay, ALogGivesBackTheTableAndJournalsTheChoices) {
  Witness witness;
  Deployment deployment("replay");
  const std::string& folder = deployment.folder;
  Process logger("/usr/bin/lcm-logger", {"-q", folder + "/bus.lcmlog"}, folder + "/logger.log");
  deployment.Simulator();
  // lcm-logger queues 30 messages and drops what comes while these wait for a processor: the search
  // must take its time, or a busy machine records it with holes.
  deployment.ModelServer({"--fixed-cost", "10,0.1"});
  std::list<Process> workers;
  for (const char* name : {"one", "two"}) {
    workers.emplace_back("prospect-worker",
                         std::vector<std::string>{"--journal", folder + "/" + name},
                         folder + "/" + name + ".log");
  }
  auto& executive = deployment.Executive({"--workers", "2", "--refusal-threshold", "1"});
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000));
  ASSERT_EQ(code, 3);
  witness.Listen(700);  // the workers' closing words
  for (Process& worker : workers) EXPECT_EQ(worker.Stop(), 0);
  logger.Signal(2);
  ASSERT_GE(logger.Wait(5000), 0);

  const json search = deployment.Result().at("searches").at(0);
  ASSERT_TRUE(search.at("converged"));
  const json rebuilt = Replay(folder, "bus", folder + "/bus.lcmlog").at("searches");
  ASSERT_EQ(rebuilt.size(), 1u);
  EXPECT_EQ(rebuilt[0].at("rollouts"), search.at("rollouts"));
  EXPECT_EQ(rebuilt[0].at("table"), search.at("table"));

  for (const char* name : {"one", "two"}) {
    const json repeated = Replay(folder, "journal", folder + "/" + name);
    EXPECT_EQ(repeated.at("searches"), 1);
    EXPECT_EQ(repeated.at("differences"), 0);
    EXPECT_GT(repeated.at("selections"), 10);
  }
}

}  // namespace
}  // namespace prospect::tests

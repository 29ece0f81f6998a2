// Two workers really share one tree: fewer evaluations for the same rollouts, and one answer.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

// Evaluations that two workers asked for, to those that the server computed: it answers what it
// knows from memory.
double AskedToComputed(const std::string& name, const std::vector<std::string>& more) {
  const std::string folder = MakeFolder(name);
  std::vector<std::string> words{
      "search",       "--workers", "2",      "--seeds", "3",      "--samples",          "150",
      "--fixed-cost", "none",      "--logs", folder,    "--json", folder + "/rows.json"};
  words.insert(words.end(), more.begin(), more.end());
  Process bench("prospect-bench", words, folder + "/bench.log");
  EXPECT_EQ(bench.Wait(60000), 0) << ReadText(folder + "/bench.log");
  const auto row = nlohmann::json::parse(ReadText(folder + "/rows.json")).at("rows").at(0);
  EXPECT_GE(row.at("overshoot"), 0);
  EXPECT_LE(row.at("overshoot"), 2 * 2) << "more than workers times leaves";
  return row.at("requested_per_rollout").get<double>() /
         row.at("evaluations_per_rollout").get<double>();
}

// Together, nearly every evaluation is asked for once; apart, what both trees hold is asked for
// twice.
TEST(Sharing, FewerEvaluationsForTheSameRollouts) {
  EXPECT_LE(AskedToComputed("together", {}), 1.33);
  EXPECT_GE(AskedToComputed("apart", {"--no-sharing"}), 1.5);
}

// After the closing round each worker notes on HEALTH what it would do.
TEST(Sharing, EveryWorkerReadsOffTheSamePlan) {
  Witness witness;
  Deployment deployment("same_plan");
  ASSERT_TRUE(deployment.Up(witness, 3));
  auto& executive = deployment.Executive({"--workers", "3", "--refusal-threshold", "0"});
  ASSERT_TRUE(witness.Until([&] { return executive.Wait(0) >= 0; }, 60000));
  const auto notes = [&] {
    std::set<std::string> found;
    for (const auto& worker : witness.Services("worker")) found.insert(worker.message);
    return found;
  };
  const std::string search = std::to_string(witness.roots.back().search_id);
  const auto agreed = [&] {
    return notes().size() == 1 && notes().begin()->find(search) != std::string::npos;
  };
  ASSERT_TRUE(witness.Until(agreed, 5000)) << *notes().begin() << " | " << *notes().rbegin();
  EXPECT_NE(notes().begin()->find("plan "), std::string::npos) << *notes().begin();
  EXPECT_EQ(witness.finals.size(), 3u);

  ASSERT_FALSE(witness.plans.empty());
  std::string steps;
  for (const auto& step : witness.plans.back().steps) {
    steps += (steps.empty() ? "" : ", ") + step.name;
  }
  EXPECT_NE(notes().begin()->find("plan " + steps + ";"), std::string::npos)
      << steps << " | " << *notes().begin();
}

}  // namespace
}  // namespace prospect::tests

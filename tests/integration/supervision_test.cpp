// What `up` starts keeps running, and nothing is left when it goes.

#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/integration/support/supervised.h"

namespace prospect::tests {
namespace {

using nlohmann::json;

// A zombie that nobody has waited for yet is dead, too.
bool IsAlive(int pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  if (!std::getline(stat, text)) return false;
  const std::size_t name_end = text.rfind(')');
  return name_end != std::string::npos && text.at(name_end + 2) != 'Z';
}

class Supervision : public testing::Test, protected Supervised {
 protected:
  Supervision()
      : Supervised(std::string("supervision_") +
                   testing::UnitTest::GetInstance()->current_test_info()->name()) {}

  Process Start(const std::string& weights = "scripted:7") {
    Options options;
    options.weights = weights;
    return Supervised::Start(options);
  }

  // prospect-supervisor's commands about this deployment; what they say is in folder/asked.log.
  int Ask(std::vector<std::string> command) {
    command.insert(command.end(), {"--state", folder});
    return Process("prospect-supervisor", command, folder + "/asked.log").Wait(15000);
  }

  bool AllGone(const std::vector<int>& pids) {
    return witness.Until(
        [&] {
          for (const int pid : pids) {
            if (IsAlive(pid)) return false;
          }
          return true;
        },
        10000);
  }
};

TEST_F(Supervision, StartsAgainWhatWasKilled) {
  Process supervisor = Start();
  ASSERT_TRUE(AllReady(2));
  for (const char* name : {"worker-1", "model", "simulator"}) {
    const int before = Services().at(name).at("pid");
    kill(before, SIGKILL);
    const auto back = [&] {
      const auto services = Services();
      return services.contains(name) && services.at(name).at("restarts") == 1 &&
             services.at(name).at("pid") != before && services.at(name).at("state") == "running";
    };
    EXPECT_TRUE(witness.Until(back, 10000)) << name;
    EXPECT_EQ(Services().at(name).at("last_exit"), 128 + SIGKILL);
  }
  const auto ready_again = [&] {
    std::map<std::string, int> ready;
    for (const auto& [name, service] : Services()) {
      for (const auto& [id, health] : witness.health) {
        if (health.pid == service.at("pid") && health.state == health_t::STATE_READY) ++ready[name];
      }
    }
    return ready.size() == 4;
  };
  EXPECT_TRUE(witness.Until(ready_again, 10000));
}

TEST_F(Supervision, MoreAndFewerWorkersWhileRunning) {
  Process supervisor = Start();
  ASSERT_TRUE(AllReady(2));
  EXPECT_EQ(Ask({"scale", "4"}), 0);
  EXPECT_TRUE(AllReady(4));
  EXPECT_EQ(Ask({"scale", "1"}), 0);
  EXPECT_TRUE(witness.Until([&] { return Services().size() == 3; }, 10000));
  EXPECT_EQ(Services().count("worker-1"), 1u) << "the newest go first";
}

TEST_F(Supervision, StopsEverythingWhenAsked) {
  Process supervisor = Start();
  ASSERT_TRUE(AllReady(2));
  const std::vector<int> pids = Pids();
  ASSERT_EQ(pids.size(), 4u);
  supervisor.Signal(SIGINT);
  int code = -1;
  EXPECT_TRUE(witness.Until([&] { return (code = supervisor.Wait(0)) >= 0; }, 8000));
  EXPECT_EQ(code, 0);
  EXPECT_TRUE(AllGone(pids));
  EXPECT_FALSE(std::filesystem::exists(folder + "/services.json"));
}

TEST_F(Supervision, LeavesNoOrphansWhenKilled) {
  Process supervisor = Start();
  ASSERT_TRUE(AllReady(2));
  const std::vector<int> pids = Pids();
  supervisor.Signal(SIGKILL);
  EXPECT_TRUE(AllGone(pids));
}

TEST_F(Supervision, ASecondOneLeavesTheFirstAlone) {
  Process first = Start();
  ASSERT_TRUE(AllReady(2));
  const std::string before = ReadText(folder + "/services.json");
  Options options;
  Process second = Supervised::Start(options, "second");
  EXPECT_EQ(second.Wait(10000), 12);
  EXPECT_NE(ReadText(folder + "/second.log").find("already up"), std::string::npos);
  EXPECT_EQ(ReadText(folder + "/services.json"), before);
  EXPECT_EQ(Ask({"join"}), 0);
  EXPECT_EQ(Ask({"stop"}), 0);
  EXPECT_EQ(first.Wait(8000), 0) << "the first can still be reached";
}

TEST_F(Supervision, WhatACrashLeftIsNobodys) {
  Process stranger("/bin/sleep", {"60"}, folder + "/stranger.log");
  {
    Process supervisor = Start();
    ASSERT_TRUE(AllReady(2));
    supervisor.Signal(SIGKILL);
    ASSERT_EQ(supervisor.Wait(5000), 128 + SIGKILL);
  }
  // As if its number had passed to the stranger.
  json left = json::parse(ReadText(folder + "/services.json"));
  left["supervisor_pid"] = stranger.pid();
  std::ofstream(folder + "/services.json") << left;
  EXPECT_EQ(Ask({"join"}), 15);
  EXPECT_EQ(Ask({"scale", "3"}), 15);
  EXPECT_EQ(Ask({"stop"}), 0);
  EXPECT_NE(ReadText(folder + "/asked.log").find("had crashed"), std::string::npos);
  EXPECT_TRUE(stranger.Running());
  EXPECT_FALSE(std::filesystem::exists(folder + "/services.json"));
}

TEST_F(Supervision, EndsWithTheProcessItLivesWith) {
  Process companion("/bin/sleep", {"60"}, folder + "/companion.log");
  Options options;
  Process supervisor =
      Supervised::Start(options, "supervisor", {"--lives-with", std::to_string(companion.pid())});
  ASSERT_TRUE(AllReady(2));
  const std::vector<int> pids = Pids();
  companion.Signal(SIGKILL);
  int code = -1;
  EXPECT_TRUE(witness.Until(
      [&] {
        companion.Running();  // a zombie has ended, too, but let us be quick
        return (code = supervisor.Wait(0)) >= 0;
      },
      8000));
  EXPECT_EQ(code, 0);
  EXPECT_TRUE(AllGone(pids));
}

TEST_F(Supervision, GivesUpWhatAnotherStartCannotMend) {
  Process supervisor = Start("/no/such/weights.safetensors");
  const auto given_up = [&] {
    const auto services = Services();
    return services.contains("model") && services.at("model").at("state") == "given_up";
  };
  ASSERT_TRUE(witness.Until(given_up, 10000));
  const json model = Services().at("model");
  EXPECT_EQ(model.at("last_exit"), 10);
  EXPECT_EQ(model.at("restarts"), 0);
  EXPECT_NE(model.at("last_words").get<std::string>().find("/no/such/weights"), std::string::npos);
  EXPECT_EQ(Ask({"given-up"}), 10);
  EXPECT_NE(ReadText(folder + "/asked.log").find("model ended: "), std::string::npos);

  // Who gives up does so sooner than a world is built.
  ASSERT_TRUE(witness.Until([&] { return witness.Ready("simulator", 1); }, 10000));
  Process status("prospect-bus",
                 {"status", "--bus", witness.bus.url(), "--services-file",
                  folder + "/services.json", "--json", folder + "/status.json"},
                 folder + "/status.log");
  ASSERT_TRUE(witness.Until([&] { return !status.Running(); }, 10000));
  EXPECT_EQ(status.Wait(0), 15);
  const json rows = json::parse(ReadText(folder + "/status.json")).at("rows");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].at("name"), "model");
  EXPECT_EQ(rows[0].at("state"), "given up");
  EXPECT_EQ(rows[1].at("name"), "simulator");
  EXPECT_EQ(rows[1].at("well"), true);
}

}  // namespace
}  // namespace prospect::tests

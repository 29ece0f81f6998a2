#include "services/executive/trial_counts.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/exit_error.h"

namespace prospect::services {
namespace {

task_t Task() {
  task_t task{};
  task.name = "made";
  task.actions = {{0, "take", "take", "", 0, {}}, {1, "put", "put", "", 0, {}}};
  task.num_actions = 2;
  return task;
}

agent::EpisodeRecord Trial(const std::string& outcome, std::vector<std::string> observed) {
  agent::EpisodeRecord record;
  record.outcome = outcome;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    record.acts.emplace_back();
    record.acts.back().action = static_cast<int>(i);
    record.acts.back().observed = observed[i];
  }
  return record;
}

class TrialCountsTest : public testing::Test {
 protected:
  TrialCountsTest() : path_(testing::TempDir() + "/trials_" + std::to_string(getpid()) + ".json") {}
  ~TrialCountsTest() override { std::filesystem::remove(path_); }

  ExitCode Refusal(const task_t& task, std::int64_t seed) {
    try {
      TrialCounts(path_, task, seed);
    } catch (const ExitError& error) {
      return error.code();
    }
    return kExitSuccess;
  }

  std::string path_;
};

TEST_F(TrialCountsTest, GoesOnWithWhatTheFileCounts) {
  {
    TrialCounts counts(path_, Task(), 100);
    EXPECT_EQ(counts.episodes(), 0);
    counts.Add(Trial("solved", {"succeeded", "succeeded"}));
    counts.Add(Trial("failed", {"succeeded", "failed"}));
    counts.Write();
  }
  TrialCounts counts(path_, Task(), 100);
  counts.Add(Trial("failed", {"failed"}));
  EXPECT_EQ(counts.episodes(), 3);
  EXPECT_EQ(counts.solved(), 1);
  const nlohmann::json file = counts.ToJson();
  EXPECT_EQ(file.at("outcomes"), (nlohmann::json{{"solved", 1}, {"failed", 2}}));
  EXPECT_EQ(file.at("actions").at(0),
            (nlohmann::json{{"name", "take"}, {"tried", 3}, {"succeeded", 2}}));
  EXPECT_EQ(file.at("actions").at(1),
            (nlohmann::json{{"name", "put"}, {"tried", 2}, {"succeeded", 1}}));
}

TEST_F(TrialCountsTest, WhatTheFileCountsMustBeTrialsOfThisTableAndSeed) {
  TrialCounts(path_, Task(), 100).Write();
  EXPECT_EQ(Refusal(Task(), 100), kExitSuccess);
  EXPECT_EQ(Refusal(Task(), 101), kExitUsage);
  task_t other = Task();
  other.actions[1].name = "throw";
  EXPECT_EQ(Refusal(other, 100), kExitUsage);
  for (const char* damaged : {"", "{", "[]", "{\"episodes\": 3}"}) {
    std::ofstream(path_) << damaged;
    EXPECT_EQ(Refusal(Task(), 100), kExitDataFile) << damaged;
  }
}

}  // namespace
}  // namespace prospect::services

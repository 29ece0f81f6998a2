#include "report/episode_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace prospect::report {
namespace {

using namespace agent;

StepRecord Step(const std::string& name, double score) {
  StepRecord step;
  step.action = 1;
  step.name = name;
  step.score = score;
  step.value = 0.9;
  step.done = 0.8;
  step.visits = 12;
  step.predicted = true;
  return step;
}

// Two steps planned, the first carried out, the second failed after a new search.
EpisodeRecord FailedEpisode() {
  EpisodeRecord record;
  record.task = "navigation";
  record.seed = 5;
  record.outcome = "failed";
  record.reason = "b failed: it ran out of time";
  SearchRecord first, second;
  first.act = second.act = true;
  first.rollouts = 30;
  second.rollouts = 20;
  first.steps = {Step("a", 0.7), Step("c", 0.6), Step("d", 0.5)};
  second.steps = {Step("b", 0.4), Step("d", 0.3)};
  record.searches = {first, second};
  ActRecord a, b;
  a.name = "a";
  a.observed = "succeeded";
  b.name = "b";
  b.observed = "failed";
  b.reason = "time";
  record.acts = {a, b};
  return record;
}

TEST(ReportTest, RowsAreTheSearchBeforeEachActAndWhatIsLeftOfThePlan) {
  const auto rows = TableRows(FailedEpisode());
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].imagined.name, "a");
  EXPECT_EQ(rows[0].imagined.score, 0.7);
  EXPECT_EQ(rows[1].imagined.name, "b");
  EXPECT_EQ(rows[1].imagined.score, 0.4);
  EXPECT_EQ(rows[1].observed, "failed");
  EXPECT_EQ(rows[2].imagined.name, "d");
  EXPECT_EQ(rows[2].observed, "");
}

TEST(ReportTest, RefusalShowsWhatItRefused) {
  EpisodeRecord record = FailedEpisode();
  record.outcome = "refused";
  record.acts.clear();
  record.searches.resize(1);
  const auto rows = TableRows(record);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].imagined.name, "a");
  EXPECT_EQ(rows[0].observed, "");
}

TEST(ReportTest, JsonHoldsWhatScriptsRead) {
  const auto json = nlohmann::json::parse(ResultJson(FailedEpisode(), 4));
  EXPECT_EQ(json.at("outcome"), "failed");
  EXPECT_EQ(json.at("exit_code"), 4);
  EXPECT_EQ(json.at("rollouts"), 50);
  EXPECT_EQ(json.at("actions").size(), 2u);
  EXPECT_EQ(json.at("steps").at(0).at("predicted"), "success");
  EXPECT_EQ(json.at("steps").at(1).at("observed"), "failed");
  EXPECT_TRUE(json.at("steps").at(2).at("observed").is_null());
}

TEST(ReportTest, TableNamesVerdict) {
  const std::string table = PlanTable(FailedEpisode());
  EXPECT_NE(table.find("Failed: b failed: it ran out of time"), std::string::npos) << table;
  EXPECT_NE(table.find("0.700"), std::string::npos) << table;
}

TEST(ReportTest, WithoutStepsThereIsNoTable) {
  EpisodeRecord record;
  record.outcome = "refused";
  record.reason = "the goal cannot be brought about";
  EXPECT_EQ(PlanTable(record), "Refused, nothing was done: the goal cannot be brought about\n");
}

// What a robot says need not be UTF-8, and must not keep result.json from being written.
TEST(ReportTest, ReasonsThatAreNoTextEndNoEpisode) {
  EpisodeRecord record = FailedEpisode();
  record.acts[1].reason = record.reason = "gripper \xff\xfe";
  record.seed = -1;
  const auto json = nlohmann::json::parse(ResultJson(record, 4));
  EXPECT_EQ(json.at("reason").get<std::string>().rfind("gripper ", 0), 0u);
  EXPECT_TRUE(json.at("seed").is_null()) << "no simulated scene";
}

}  // namespace
}  // namespace prospect::report

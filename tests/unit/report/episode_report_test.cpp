#include "report/episode_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/agent/calibration_sample.h"
#include "tests/unit/report/failed_episode.h"

namespace prospect::report {
namespace {

using namespace agent;

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
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

TEST(ConfidenceInReports, StandsInTheTableAndInResultJson) {
  EpisodeRecord record;
  record.outcome = "solved";
  record.confidence = ConfidenceOf(Sample(), 0.21, 0);
  record.terms = TermsOf(Sample(), "paper", {}, false);
  record.terms->promises = {"Refuses at most 5 %."};
  EXPECT_TRUE(Holds(PlanTable(record), "At the start: Succeeds in about 33 %"));
  EXPECT_TRUE(Holds(PlanTable(record), "Refuses at most 5 %."));
  const std::string json = ResultJson(record, 0);
  EXPECT_TRUE(Holds(json, "\"success\": 0.3333"));
  EXPECT_TRUE(Holds(json, "\"calibration_scenes\": 80"));
  record.confidence.reset();
  EXPECT_TRUE(Holds(ResultJson(record, 0), "\"confidence\": null"));
  EXPECT_FALSE(Holds(PlanTable(record), "At the start"));
}

}  // namespace
}  // namespace prospect::report

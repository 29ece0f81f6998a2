#include "services/executive/report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "services/executive/explanation_pictures.h"
#include "services/executive/plan_picture.h"
#include "services/executive/risk_chart.h"
#include "tests/unit/agent/calibration_sample.h"

namespace prospect::services {
namespace {

using namespace agent;

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

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

TEST(ReportTest, PictureIsWrittenWithAndWithoutImages) {
  if (!PROSPECT_PICTURES) GTEST_SKIP() << "built without OpenCV";
  const std::string path = testing::TempDir() + "plan_picture_" + std::to_string(getpid()) + ".png";
  EpisodeRecord record = FailedEpisode();
  WritePlanPicture(record, path);
  record.first = {2, 2, std::vector<std::uint8_t>(12, 200)};
  record.searches[0].steps[0].imagined = record.first;
  WritePlanPicture(record, path);
  EXPECT_GT(std::filesystem::file_size(path), 1000u);
  std::filesystem::remove(path);
  EXPECT_THROW(WritePlanPicture(record, "/nonexistent-folder/plan.png"), std::runtime_error);
}

// Width and height of a PNG, from its header.
std::pair<unsigned, unsigned> SizeOf(const std::string& path) {
  unsigned char head[24] = {};
  std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(head), sizeof head);
  const auto number = [&](int at) {
    return static_cast<unsigned>(head[at] << 24 | head[at + 1] << 16 | head[at + 2] << 8 |
                                 head[at + 3]);
  };
  return {number(16), number(20)};
}

TEST(ReportTest, PicturesOfLongPlansGoOnBelow) {
  if (!PROSPECT_PICTURES) GTEST_SKIP() << "built without OpenCV";
  const std::string folder = testing::TempDir() + "long_plan_" + std::to_string(getpid());
  std::filesystem::create_directories(folder);
  EpisodeRecord record = FailedEpisode();
  record.acts.assign(18, record.acts.front());
  const Picture seen{2, 2, std::vector<std::uint8_t>(12, 200)};
  for (auto& act : record.acts) act.picture = seen;
  WritePlanPicture(record, folder + "/plan.png");
  Explanation explanation;
  explanation.chosen.steps.assign(18, {});
  WriteExplanationPictures(explanation, folder);
  for (const char* name : {"/plan.png", "/chosen.png"}) {
    const auto [width, height] = SizeOf(folder + name);
    EXPECT_LE(width, 1900u) << name;
    EXPECT_GT(height, 500u) << name;
  }
  std::filesystem::remove_all(folder);
}

TEST(RiskChart, ShowsTheCurveAndTheThresholdOnIt) {
  const RefusalTerms terms = TermsOf(Sample(), "paper", {}, false);
  const std::string chart = RiskChart(terms, 0.5);
  EXPECT_EQ(chart.rfind("<svg ", 0), 0u);
  EXPECT_TRUE(Holds(chart, "<polyline "));
  EXPECT_TRUE(Holds(chart, "<circle ")) << "the threshold";
  EXPECT_FALSE(Holds(RiskChart(terms, 0.9), "<circle ")) << "above every score";
  // Half of the wide range: 50 of 80 are attempted at 0.5, at x = 48 + 0.625 * 298.
  EXPECT_TRUE(Holds(chart, "<circle cx=\"234.2\"")) << chart;
  EXPECT_EQ(RiskChart({}, 0.5), "");
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
}  // namespace prospect::services

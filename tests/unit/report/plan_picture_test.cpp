#include "report/plan_picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "report/explanation_pictures.h"
#include "tests/unit/report/png_size.h"

namespace prospect::report {

using namespace agent;

namespace {

StepRecord Step(const std::string& name) {
  StepRecord step;
  step.name = name;
  step.score = 0.7;
  step.value = 0.9;
  step.done = 0.8;
  step.visits = 12;
  step.predicted = true;
  return step;
}

ActRecord Act(const std::string& name, const std::string& observed, const std::string& reason) {
  ActRecord act;
  act.name = name;
  act.observed = observed;
  act.reason = reason;
  return act;
}

// Two steps planned, the first carried out, the second failed after a new search.
EpisodeRecord Episode() {
  EpisodeRecord record;
  record.task = "navigation";
  record.seed = 5;
  record.outcome = "failed";
  record.reason = "b failed: it ran out of time";
  SearchRecord first, second;
  first.act = second.act = true;
  first.steps = {Step("a"), Step("c"), Step("d")};
  second.steps = {Step("b"), Step("d")};
  record.searches = {first, second};
  record.acts = {Act("a", "succeeded", ""), Act("b", "failed", "time")};
  return record;
}

TEST(PlanPicture, IsWrittenWithAndWithoutImages) {
  const std::string path = testing::TempDir() + "plan_picture_" + std::to_string(getpid()) + ".png";
  EpisodeRecord record = Episode();
  WritePlanPicture(record, path);
  record.first = {2, 2, std::vector<std::uint8_t>(12, 200)};
  record.searches[0].steps[0].imagined = record.first;
  WritePlanPicture(record, path);
  EXPECT_GT(std::filesystem::file_size(path), 1000u);
  std::filesystem::remove(path);
  EXPECT_THROW(WritePlanPicture(record, "/nonexistent-folder/plan.png"), std::runtime_error);
}

TEST(PlanPicture, LongPlansGoOnBelow) {
  const std::string folder = testing::TempDir() + "long_plan_" + std::to_string(getpid());
  std::filesystem::create_directories(folder);
  EpisodeRecord record = Episode();
  record.acts.assign(18, record.acts.front());
  const sim::Image seen{2, 2, std::vector<std::uint8_t>(12, 200)};
  for (auto& act : record.acts) act.picture = seen;
  WritePlanPicture(record, folder + "/plan.png");
  Explanation explanation;
  explanation.chosen.steps.assign(18, {});
  WriteExplanationPictures(explanation, folder);
  for (const char* name : {"/plan.png", "/chosen.png"}) {
    const auto [width, height] = PngSize(folder + name);
    EXPECT_LE(width, 1900u) << name;
    EXPECT_GT(height, 500u) << name;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace prospect::report

#include "report/plan_picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "report/explanation_pictures.h"
#include "tests/unit/report/failed_episode.h"
#include "tests/unit/report/png_size.h"

namespace prospect::report {

using namespace agent;

namespace {

TEST(PlanPicture, IsWrittenWithAndWithoutImages) {
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

TEST(PlanPicture, LongPlansGoOnBelow) {
  const std::string folder = testing::TempDir() + "long_plan_" + std::to_string(getpid());
  std::filesystem::create_directories(folder);
  EpisodeRecord record = FailedEpisode();
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

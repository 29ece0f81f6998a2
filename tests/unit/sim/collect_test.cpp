#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "model/dataset.h"
#include "tools/collect/collector.h"
#include "tools/collect/scene_tasks.h"
#include "tools/collect/trial_recorder.h"

namespace prospect::tools {
namespace {

namespace fs = std::filesystem;

class CollectTest : public testing::Test {
 protected:
  CollectTest() : folder_(testing::TempDir() + "prospect_collect_" + std::to_string(getpid())) {
    fs::create_directories(folder_);
    options_.task = "navigation";
    options_.trials = 6;
    options_.seed = 100;
    options_.out = folder_ + "/set.h5";
    options_.scenes.objects = options_.scenes.legs = "mixed";
  }
  ~CollectTest() override { fs::remove_all(folder_); }

  std::string folder_;
  cli::CollectOptions options_;
};

TEST_F(CollectTest, RecordsWholeValidTrials) {
  const CollectSummary summary = Collect(options_);
  EXPECT_EQ(summary.trials, 6);
  const model::TrialFile file(options_.out);
  ASSERT_EQ(file.size(), 6u);
  int successes = 0;
  for (std::size_t i = 0; i < file.size(); ++i) {
    const model::Trial trial = file.Read(i);
    model::ValidateTrial(trial);
    EXPECT_EQ(trial.seed, 100 + i);
    EXPECT_EQ(trial.segment.front(), -1);
    EXPECT_EQ(trial.dones.back(), 1);
    EXPECT_EQ(std::count(trial.dones.begin(), trial.dones.end(), 1), 1);
    EXPECT_EQ(trial.succeeded(), trial.segment_succeeded.back() == 1);
    EXPECT_EQ(trial.succeeded(), trial.segments() == trial.plan_length && trial.reason.empty());
    successes += trial.succeeded();
  }
  EXPECT_EQ(successes, summary.successes);
  EXPECT_FALSE(fs::exists(options_.out + ".parts"));
}

TEST_F(CollectTest, ATrialIsAFunctionOfItsSeed) {
  auto one = sim::MakeTask("navigation");
  auto other = sim::MakeTask("navigation");
  RecordRandomTrial(*other, 4, 0.01);
  const model::Trial a = RecordRandomTrial(*one, 5, 0.01);
  const model::Trial b = RecordRandomTrial(*other, 5, 0.01);
  EXPECT_EQ(a.images, b.images);
  EXPECT_EQ(a.actions, b.actions);
  EXPECT_EQ(a.outcome, b.outcome);
}

TEST_F(CollectTest, WithForesightMoreTrialsGetFarAndEqualSeedsAreEqual) {
  sim::TaskOptions site;
  site.objects = 7;
  site.legs = 5;
  const auto task = sim::MakeTask("navigation", site);
  const auto other = sim::MakeTask("navigation", site);
  int blind = 0, ahead = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    blind += RecordRandomTrial(*task, seed, 0.01).segments();
    ahead += RecordRandomTrial(*task, seed, 0.01, 0.9).segments();
  }
  EXPECT_GT(ahead, blind + 20);  // a leg a trial
  const model::Trial a = RecordRandomTrial(*task, 3, 0.01, 0.9);
  const model::Trial b = RecordRandomTrial(*other, 3, 0.01, 0.9);
  EXPECT_EQ(a.images, b.images);
  EXPECT_EQ(a.actions, b.actions);
}

TEST_F(CollectTest, ResumesWithoutDoingWorkTwiceAndEqualsAnUninterruptedRun) {
  Collect(options_);
  const model::TrialFile whole(options_.out);
  cli::CollectOptions again = options_;
  again.out = folder_ + "/again.h5";
  again.keep_parts = true;
  again.trials = 4;
  Collect(again);
  std::ofstream(again.out + ".parts/trial_101.h5", std::ios::trunc) << "killed here";
  again.trials = 6;
  EXPECT_THROW(Collect(again), CollectUsageError);  // parts of an earlier run, but no --resume
  again.resume = true;
  const CollectSummary summary = Collect(again);
  EXPECT_EQ(summary.kept, 3);
  const model::TrialFile resumed(again.out);
  ASSERT_EQ(resumed.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(resumed.Read(i).images, whole.Read(i).images);
  }
}

TEST_F(CollectTest, RefusesPartsOfOtherOptions) {
  options_.keep_parts = true;
  Collect(options_);
  options_.resume = true;
  options_.scenes.legs = "3";
  EXPECT_THROW(Collect(options_), CollectUsageError);
}

TEST_F(CollectTest, RefusesBadRequestsBeforeAnyWork) {
  for (auto break_it :
       {+[](cli::CollectOptions* o) { o->seed = 999'996; },
        +[](cli::CollectOptions* o) { o->seed = 2'000'000; },
        +[](cli::CollectOptions* o) { o->task = "cooking"; },
        +[](cli::CollectOptions* o) { o->scenes.objects = "9"; },
        +[](cli::CollectOptions* o) { o->scenes.objects = "many"; },
        +[](cli::CollectOptions* o) { o->scenes.objects = "4", o->scenes.legs = "5"; }}) {
    cli::CollectOptions bad = options_;
    break_it(&bad);
    EXPECT_THROW(Collect(bad), CollectUsageError);
    EXPECT_FALSE(fs::exists(bad.out + ".parts"));
  }
}

TEST_F(CollectTest, MixedScenesCoverTheRangeAndHalfArePlain) {
  int plain = 0;
  std::map<std::pair<int, int>, int> seen;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const sim::TaskOptions scene = SceneOptions(options_.scenes, seed);
    plain += scene.objects == 4 && scene.legs == 3;
    ++seen[{scene.objects, scene.legs}];
    EXPECT_LE(scene.legs, std::min(5, scene.objects));
  }
  EXPECT_NEAR(plain, 1000 + 2000 / 16, 80);
  EXPECT_EQ(seen.size(), 2u + 3 * 3);  // 4: 3 and 4 legs; 5, 6, 7: 3 to 5
}

TEST_F(CollectTest, MixedTowersAreOfTwoToFourBlocksAndEachTrialHasItsOwn) {
  options_.scenes = {};
  options_.scenes.tower = "mixed";
  std::map<int, int> seen;
  for (std::uint64_t seed = 0; seed < 600; ++seed)
    ++seen[SceneOptions(options_.scenes, seed).tower];
  ASSERT_EQ(seen.size(), 3u);
  for (const auto& [tower, trials] : seen) EXPECT_NEAR(trials, 200, 50) << tower;
  SceneTasks tasks("stacking");
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const sim::TaskOptions scene = SceneOptions(options_.scenes, seed);
    EXPECT_EQ(tasks.Get(scene).spec().plan_length, 9 * (scene.tower - 1));
  }
}

TEST_F(CollectTest, ForesightLooksAsFarAsTheNextChoice) {
  const auto task = sim::MakeTask("stacking");
  int blind = 0, ahead = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    blind += RecordRandomTrial(*task, seed, 0.01).succeeded();
    ahead += RecordRandomTrial(*task, seed, 0.01, 1).succeeded();
  }
  EXPECT_GT(ahead, blind + 1) << "of 8 trials";
}

}  // namespace
}  // namespace prospect::tools

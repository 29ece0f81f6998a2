#include "model/training/samples.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "model/training/mapped_file.h"
#include "model/training/measures.h"
#include "model/training/random.h"
#include "model/training/train_config.h"
#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/task_config.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

// MadeTrial(seed, 3 segments, fails, length 6): frame 0 null, segments on 1-6, 7-12, 13-18.
SampleSet Samples(bool fails, int mids) {
  SampleSet set;
  AddTrial(MadeTrial(3, 3, fails, 6), 0, mids, &set);
  return set;
}

int FrameOf(const SampleSet& set, int slot) {
  return set.frames[static_cast<std::size_t>(slot)].frame;
}

TEST(Samples, GoalIsWhereTheNextSegmentBeginsOrTheTrialEnds) {
  const SampleSet set = Samples(false, 0);
  ASSERT_EQ(set.segments.size(), 3U);
  EXPECT_EQ(FrameOf(set, set.segments[0].start), 1);
  EXPECT_EQ(FrameOf(set, set.segments[0].goal), 7);
  EXPECT_EQ(FrameOf(set, set.segments[1].start), 7);
  EXPECT_EQ(FrameOf(set, set.segments[1].goal), 13);
  EXPECT_EQ(FrameOf(set, set.segments[2].goal), 18);
  EXPECT_EQ(FrameOf(set, set.trials[0].first), 0);
  EXPECT_EQ(set.segments[0].goal, set.segments[1].start) << "one frame has one slot";
}

TEST(Samples, ActionsAndOutcomesAreThoseOfTheTrial) {
  const SampleSet set = Samples(true, 0);
  EXPECT_EQ(set.segments[0].action, 0);  // seed 3: (3 + segment) % 3
  EXPECT_EQ(set.segments[0].previous, 3);
  EXPECT_EQ(set.segments[1].action, 1);
  EXPECT_EQ(set.segments[1].previous, 0);
  EXPECT_FALSE(set.trials[0].succeeded);
  EXPECT_TRUE(set.segments[1].succeeded);
  EXPECT_FALSE(set.segments[2].succeeded);
}

TEST(Samples, FramesInsideAreWellBeforeTheEnd) {
  const SampleSet set = Samples(false, 20);
  std::set<int> seen;
  for (const int slot : set.segments[1].mids) seen.insert(FrameOf(set, slot));
  // Segment 1 begins at 7 and ends at 13; ticks are 0.1 s, so 8, 9 and 10 are at least 0.3 s
  // before.
  EXPECT_EQ(seen, (std::set<int>{8, 9, 10}));
}

TEST(Samples, AreTheSameEveryTime) {
  const SampleSet a = Samples(false, 2);
  const SampleSet b = Samples(false, 2);
  EXPECT_EQ(a.segments[0].mids, b.segments[0].mids);
  EXPECT_EQ(a.frames.size(), b.frames.size());
}

TEST(Samples, TooShortASegmentHasNoFramesInside) {
  SampleSet set;
  AddTrial(MadeTrial(3, 2, false, 3), 0, 2, &set);
  EXPECT_TRUE(set.segments[0].mids.empty());
}

TEST(Samples, AnActionMayFollowIfItIsOfferedAndNotTheLast) {
  SampleSet set;
  Trial trial = MadeTrial(3);
  trial.present = {1, 0, 1};
  AddTrial(trial, 0, 0, &set);
  EXPECT_TRUE(MayFollow(set, set.trials[0], 3, 0));
  EXPECT_FALSE(MayFollow(set, set.trials[0], 3, 1)) << "not on site";
  EXPECT_FALSE(MayFollow(set, set.trials[0], 2, 2)) << "just done";
  EXPECT_TRUE(MayFollow(set, set.trials[0], 0, 2));
}

TEST(Samples, AnActionMayFollowIfTheGraphLetsIt) {
  SampleSet set;
  Trial trial = MadeTrial(3);
  trial.present = {1, 0, 1};
  trial.successors = {{0, 1}, {}, {2}, {0}};
  AddTrial(trial, 0, 0, &set);
  EXPECT_TRUE(MayFollow(set, set.trials[0], 0, 0)) << "the graph lets it repeat";
  EXPECT_FALSE(MayFollow(set, set.trials[0], 0, 1)) << "not on site";
  EXPECT_FALSE(MayFollow(set, set.trials[0], 0, 2));
  EXPECT_TRUE(MayFollow(set, set.trials[0], 3, 0)) << "at the start";
  EXPECT_FALSE(MayFollow(set, set.trials[0], 3, 2));
}

TEST(Samples, TrialsWithoutActionsAreNotTrainedOn) {
  SampleSet set;
  AddTrial(MadeTrial(3, 0), 0, 0, &set);
  EXPECT_TRUE(set.TrialsOf(SplitOf(3)).empty());
  EXPECT_EQ(set.FramesOf(SplitOf(3)).size(), 1U);
}

TEST(Samples, RefuseATrialOfAnotherKind) {
  SampleSet set = Samples(false, 0);
  Trial other = MadeTrial(4);
  other.task = "other";
  EXPECT_THROW(AddTrial(other, 1, 0, &set), DataError);
}

TEST(CounterRandom, IsAFunctionOfItsThreeNumbers) {
  EXPECT_EQ(CounterRandom(1, 2, 3).Next(), 0x12588d809dce88a7ULL);
  std::set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 10; ++i) {
    seen.insert(CounterRandom(i, 0, 0).Next());
    seen.insert(CounterRandom(0, i + 100, 0).Next());
    seen.insert(CounterRandom(0, 0, i + 200).Next());
  }
  EXPECT_EQ(seen.size(), 30U);
  CounterRandom random(1, 1, 1);
  double sum = 0;
  for (int i = 0; i < 10'000; ++i) sum += random.Uniform();
  EXPECT_NEAR(sum / 10'000, 0.5, 0.02);
}

TEST(Measures, BalancedAccuracyWeighsBothKindsEqually) {
  const Judgements some = {{0.9F, true}, {0.8F, true}, {0.2F, true}, {0.1F, false}};
  EXPECT_DOUBLE_EQ(BalancedAccuracy(some, 0.5), 0.5 * (2.0 / 3.0 + 1.0));
  EXPECT_DOUBLE_EQ(BalancedAccuracy(some, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(BalancedAccuracy({}, 0.5), 0.5);
}

TEST(Measures, TheBestThresholdSeparates) {
  const Judgements some = {{0.9F, true}, {0.4F, true}, {0.3F, false}, {0.1F, false}};
  EXPECT_FLOAT_EQ(static_cast<float>(BestThreshold(some)), 0.4F);
  EXPECT_DOUBLE_EQ(BalancedAccuracy(some, BestThreshold(some)), 1.0);
  EXPECT_DOUBLE_EQ(BestThreshold({{0.3F, true}}), 0.5);
}

TEST(Measures, BrierOfTheBaseRateIsItsVariance) {
  const Judgements some = {{0.25F, true}, {0.25F, false}, {0.25F, false}, {0.25F, false}};
  EXPECT_DOUBLE_EQ(BaseRate(some), 0.25);
  EXPECT_DOUBLE_EQ(BrierScore(some), 0.25 * 0.75);
  EXPECT_DOUBLE_EQ(Accuracy(some), 0.75);
}

TEST(Measures, AreaUnderTheRocCountsPairs) {
  const Judgements some = {{0.9F, true}, {0.5F, false}, {0.4F, true}, {0.4F, false}, {0.1F, false}};
  // Pairs won: 0.9 all three; 0.4 loses to 0.5, ties with 0.4, beats 0.1.
  EXPECT_DOUBLE_EQ(AreaUnderRoc(some), (3 + 0 + 0.5 + 1) / 6);
  EXPECT_DOUBLE_EQ(AreaUnderRoc({{0.3F, true}, {0.3F, false}}), 0.5);
  EXPECT_DOUBLE_EQ(AreaUnderRoc({{0.3F, true}}), 0.5);
}

TEST(Measures, RecallIsOfTheTrueOnes) {
  const Judgements some = {{0.2F, true}, {0.09F, true}, {0.05F, true}, {0.9F, false}};
  EXPECT_DOUBLE_EQ(Recall(some, 0.1), 1.0 / 3);
  EXPECT_DOUBLE_EQ(Recall({}, 0.1), 0);
}

TEST(MappedFile, FillsOnceAndMapsAgain) {
  const TestFolder folder;
  int fills = 0;
  const auto fill = [&](void* out) {
    ++fills;
    std::memset(out, 7, 100);
  };
  {
    const MappedFile first(folder / "cache", 100, fill);
    EXPECT_EQ(static_cast<const char*>(first.data())[99], 7);
  }
  const MappedFile again(folder / "cache", 100, fill);
  EXPECT_EQ(fills, 1);
  EXPECT_EQ(static_cast<const char*>(again.data())[0], 7);
}

// As after a killed writer, or on a bad disk: the right name and length, other bytes.
TEST(MappedFile, WhatItsChecksumDoesNotFitIsMadeAnewAndSaid) {
  const TestFolder folder;
  const auto fill = [](void* out) { std::memset(out, 7, 100); };
  MappedFile(folder / "cache", 100, fill);
  const auto size = std::filesystem::file_size(folder / "cache");
  for (const std::streamoff place : {std::streamoff{0}, static_cast<std::streamoff>(size) - 1}) {
    std::fstream(folder / "cache", std::ios::in | std::ios::out | std::ios::binary).seekp(place)
        << '\1';
    testing::internal::CaptureStderr();
    const MappedFile again(folder / "cache", 100, fill);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("cache: is damaged"), std::string::npos);
    EXPECT_EQ(static_cast<const char*>(again.data())[0], 7);
  }
  std::ofstream(folder / "cache") << std::string(size, '\0');
  EXPECT_EQ(static_cast<const char*>(MappedFile(folder / "cache", 100, fill).data())[50], 7);
}

TEST(MappedFile, TwoThatFillAtOnceDoNotHarmEachOther) {
  const TestFolder folder;
  const auto fill = [](void* out) { std::memset(out, 7, 100); };
  EXPECT_THROW(MappedFile(folder / "cache", 100,
                          [&](void* out) {
                            std::memset(out, 7, 50);
                            MappedFile(folder / "cache", 100, fill);
                            throw std::runtime_error("stopped half way");
                          }),
               std::runtime_error);
  const MappedFile left(folder / "cache", 100, [](void*) { FAIL() << "it was whole"; });
  EXPECT_EQ(static_cast<const char*>(left.data())[99], 7);
}

TEST(MappedFile, AFailedFillLeavesNothing) {
  const TestFolder folder;
  EXPECT_THROW(MappedFile(folder / "cache", 100, [](void*) { throw std::runtime_error("no"); }),
               std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THROW(MappedFile(folder / "absent/cache", 100, [](void*) {}), std::runtime_error);
}

TEST(TrainConfig, JsonChangesOnlyWhatItNames) {
  TrainConfig config = TrainConfigFor("navigation");
  const TrainConfig before = config;
  nlohmann::json::parse(R"({"heads": {"iterations": 5}, "network": {"dropout": 0.2}})")
      .get_to(config);
  EXPECT_EQ(config.heads.iterations, 5);
  EXPECT_EQ(config.heads.batch, before.heads.batch);
  EXPECT_DOUBLE_EQ(config.network.dropout, 0.2);
  EXPECT_EQ(config.network.num_actions, 7);
  EXPECT_DOUBLE_EQ(config.focus, before.focus);
}

TEST(TrainConfig, GoesThroughJsonUnchanged) {
  const TrainConfig config = TrainConfigFor("navigation");
  TrainConfig back;
  nlohmann::json(config).get_to(back);
  EXPECT_EQ(nlohmann::json(back), nlohmann::json(config));
}

TEST(TrainConfig, RefusesWhatItDoesNotKnow) {
  const auto refused = [](const char* text) {
    TrainConfig config = TrainConfigFor("navigation");
    EXPECT_THROW(nlohmann::json::parse(text).get_to(config), std::invalid_argument) << text;
  };
  refused(R"({"iterationz": 5})");
  refused(R"({"heads": {"iterations": "many"}})");
  refused(R"({"augment": "rotate"})");
  refused(R"({"linked_steps": 0})");
  refused(R"({"network": {"image_width": 20}})");
  refused(R"({"network": {"activation": "tanh"}})");
  refused(R"({"shards": 2.7})");
  refused(R"({"shards": true})");
  refused(R"({"shards": 4294967298})");
  refused(R"({"seed": -1})");
  refused(R"({"compose": 1})");
  refused(R"({"lambda": 1e300})");
  refused(R"({"done_weight": -1})");
  refused(R"({"checkpoint_seconds": -5})");
}

TEST(TrainConfig, ScalesAllStagesTogether) {
  TrainConfig config = TrainConfigFor("navigation");
  const TrainConfig before = config;
  const std::int64_t half =
      (before.transform_hidden.iterations + before.transform_image.iterations) / 2;
  ScaleIterations(half, &config);
  EXPECT_NEAR(static_cast<double>(config.heads.iterations),
              static_cast<double>(before.heads.iterations) / 2, 1.0);
  EXPECT_NEAR(static_cast<double>(config.encoder_decoder.iterations),
              static_cast<double>(before.encoder_decoder.iterations) / 2, 1.0);
}

}  // namespace
}  // namespace prospect::model

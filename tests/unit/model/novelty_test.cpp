#include "model/novelty.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <random>

#include "model/weights_file.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

constexpr int kResidual = 6, kState = 20;

// Gaussian vectors whose spread differs from axis to axis, `far` times as far out as usual.
NoveltySample Draw(std::mt19937_64* random, double far = 1) {
  std::normal_distribution<double> normal;
  NoveltySample sample;
  for (int i = 0; i < kResidual; ++i)
    sample.residual.push_back(static_cast<float>(0.01 * (1 + i) * far * normal(*random)));
  for (int i = 0; i < kState; ++i)
    sample.state.push_back(static_cast<float>(3 + (1 + i) * far * normal(*random)));
  sample.error = 0.01 * far * std::abs(normal(*random));
  return sample;
}

std::vector<NoveltySample> DrawMany(int count, std::mt19937_64* random) {
  std::vector<NoveltySample> samples;
  for (int i = 0; i < count; ++i) samples.push_back(Draw(random));
  return samples;
}

NoveltyGauge Gauge(int fitted = 400, int ranked = 199) {
  std::mt19937_64 random(5);
  const auto fit = DrawMany(fitted, &random);
  return NoveltyGauge(fit, DrawMany(ranked, &random));
}

TEST(NoveltyGauge, TheFarthestIsTwiceTheSmallestShare) {
  const NoveltyGauge gauge = Gauge();
  EXPECT_EQ(gauge.ranked(), 199u);
  std::mt19937_64 random(7);
  const Novelty novelty = gauge.Judge(Draw(&random, 40));
  EXPECT_DOUBLE_EQ(novelty.p, 2.0 / 200);  // nothing but itself lies as far out
  EXPECT_GT(novelty.residual, novelty.residual_limit);
  EXPECT_GT(novelty.state, novelty.state_limit);
  NoveltySample usual = Draw(&random);
  std::fill(usual.residual.begin(), usual.residual.end(), 0.0F);
  std::fill(usual.state.begin(), usual.state.end(), 3.0F);
  EXPECT_DOUBLE_EQ(gauge.Judge(usual).p, 1.0);  // nothing lies nearer: 2 x 200 / 200, at most 1
}

// Of the ranked pictures themselves, each by its own rank.
TEST(NoveltyGauge, RanksAreCountedAmongTheRankedOnes) {
  std::mt19937_64 random(11);
  const auto fit = DrawMany(300, &random), rank = DrawMany(99, &random);
  const NoveltyGauge gauge(fit, rank);
  std::vector<double> distances;
  for (const auto& sample : rank) distances.push_back(gauge.Judge(sample).state);
  std::sort(distances.begin(), distances.end());
  NoveltySample known = rank[0];
  std::fill(known.residual.begin(), known.residual.end(), 0.0F);
  for (const NoveltySample& sample : rank) {
    known.state = sample.state;
    const Novelty novelty = gauge.Judge(known);
    const auto beyond = std::count_if(distances.begin(), distances.end(),
                                      [&](double d) { return d >= novelty.state - 2e-3; });
    const auto surely = std::count_if(distances.begin(), distances.end(),
                                      [&](double d) { return d >= novelty.state + 2e-3; });
    EXPECT_LE(novelty.p, std::min(1.0, 2.0 * (1 + static_cast<double>(beyond)) / 100));
    EXPECT_GE(novelty.p, std::min(1.0, 2.0 * (1 + static_cast<double>(surely)) / 100));
  }
}

TEST(NoveltyGauge, KnownOnesAreRefusedAsOftenAsAskedFor) {
  const NoveltyGauge gauge = Gauge(1000, 999);
  std::mt19937_64 random(13);
  int below = 0;
  constexpr int kDraws = 2000;
  for (int i = 0; i < kDraws; ++i) below += gauge.Judge(Draw(&random)).p < 0.1;
  // At most 10 %, by Bonferroni; more than half of that, as the two distances differ.
  EXPECT_LT(below, kDraws * 0.12);
  EXPECT_GT(below, kDraws * 0.06);
}

// Far out along an axis along which known ones hardly differ, though not in absolute terms.
TEST(NoveltyGauge, DistancesAreInUnitsOfTheSpread) {
  const NoveltyGauge gauge = Gauge();
  std::mt19937_64 random(17);
  NoveltySample sample = Draw(&random);
  std::fill(sample.state.begin(), sample.state.end(), 3.0F);
  sample.state.back() = 3 + 20;  // one of its deviations
  const double usual = gauge.Judge(sample).state;
  sample.state.back() = 3;
  sample.state.front() = 3 + 20;  // twenty of its deviations
  EXPECT_GT(gauge.Judge(sample).state, 10 * usual);
}

TEST(NoveltyGauge, RefusesWhatItCannotCompare) {
  std::mt19937_64 random(19);
  EXPECT_THROW(NoveltyGauge(DrawMany(3, &random), DrawMany(99, &random)), std::invalid_argument);
  NoveltySample small = Draw(&random);
  small.state.pop_back();
  EXPECT_THROW(Gauge().Judge(small), std::invalid_argument);
}

TEST(CompareRedrawn, LightAloneIsNoDifference) {
  std::mt19937_64 random(23);
  std::vector<std::uint8_t> redrawn(64 * 64 * 3), picture;
  for (auto& value : redrawn) value = static_cast<std::uint8_t>(2 * (random() % 100));
  for (const auto value : redrawn) picture.push_back(static_cast<std::uint8_t>(value / 2));
  const NoveltySample dark = CompareRedrawn(picture, redrawn, 64, 64, {1, 2});
  EXPECT_NEAR(dark.error, 0, 1e-6);
  EXPECT_EQ(dark.residual.size(), 192u);
  EXPECT_EQ(dark.state, Hidden({1, 2}));
}

TEST(CompareRedrawn, APatchIsFoundWhereItIs) {
  const std::vector<std::uint8_t> redrawn(64 * 64 * 3, 100);
  std::vector<std::uint8_t> picture = redrawn;
  for (int y = 16; y < 24; ++y) {
    for (int x = 40; x < 48; ++x) picture[static_cast<std::size_t>(y * 64 + x) * 3 + 1] = 200;
  }
  const NoveltySample sample = CompareRedrawn(picture, redrawn, 64, 64, {});
  const auto most = std::max_element(sample.residual.begin(), sample.residual.end());
  EXPECT_EQ(most - sample.residual.begin(), (2 * 8 + 5) * 3 + 1);
  EXPECT_NEAR(*most, 100.0 / 255, 0.01);
  EXPECT_THROW(CompareRedrawn(picture, redrawn, 60, 64, {}), std::invalid_argument);
}

TEST(DescribeNovelty, NamesWhatStandsOutAndItsLimit) {
  Novelty novelty{0.002, 0.051, 0.02, 3.0, 1.2, 1.0, 1.3};
  EXPECT_EQ(NoveltyRefusal(novelty),
            "this picture is unlike what the networks were trained on (p 0.002: it cannot be "
            "redrawn: error 0.051, 99 % of known pictures stay below 0.020)");
  novelty.error = 0.01;
  EXPECT_EQ(DescribeNovelty(novelty),
            "p 0.002: it cannot be redrawn: parts of it differ 3.00 times as much as usual, 99 % "
            "of known pictures stay below 1.20");
  novelty.state = 9;
  EXPECT_EQ(DescribeNovelty(novelty),
            "p 0.002: its hidden state lies 9.00 times as far out as usual, 99 % of known pictures "
            "stay below 1.30");
}

StoredTensor Ones(const std::vector<std::int64_t>& shape) {
  std::int64_t count = 1;
  for (const std::int64_t extent : shape) count *= extent;
  return HalfTensor(shape, std::vector<float>(static_cast<std::size_t>(count), 1.0F));
}

class StoredNovelty : public testing::Test {
 protected:
  StoredNovelty() : path_(folder_ / "w.safetensors") {
    WriteWeights(path_, {{"encoder.w", Ones({2, 3})}}, {{"task", "navigation"}});
  }

  TestFolder folder_;
  std::string path_;
};

TEST_F(StoredNovelty, JudgesAsBefore) {
  EXPECT_FALSE(NoveltyGauge::Load(path_));
  const NoveltyGauge gauge = Gauge();
  StoreNovelty(path_, gauge, {1500000, 400, 199, "a command"});
  const auto loaded = NoveltyGauge::Load(path_);
  ASSERT_TRUE(loaded);
  std::mt19937_64 random(29);
  for (int i = 0; i < 50; ++i) {
    const NoveltySample sample = Draw(&random, 1 + i % 3);
    const Novelty before = gauge.Judge(sample), after = loaded->Judge(sample);
    EXPECT_EQ(before.p, after.p);
    EXPECT_EQ(before.state, after.state);
    EXPECT_EQ(before.residual, after.residual);
    EXPECT_EQ(before.error_limit, after.error_limit);
  }
  const WeightsFile file = ReadWeights(path_);
  EXPECT_EQ(file.metadata["task"], "navigation");
  EXPECT_EQ(file.metadata["novelty"]["command"], "a command");
  EXPECT_EQ(file.tensors.at("encoder.w").bytes, Ones({2, 3}).bytes);
}

TEST_F(StoredNovelty, DamageIsNamed) {
  StoreNovelty(path_, Gauge(), {});
  const WeightsFile whole = ReadWeights(path_);
  const auto expect_refused = [&](const std::map<std::string, StoredTensor>& tensors) {
    WriteWeights(path_, tensors, whole.metadata);
    EXPECT_THROW(NoveltyGauge::Load(path_), WeightsError);
  };
  auto damaged = whole.tensors;
  damaged.erase("novelty.state.axes");
  expect_refused(damaged);
  damaged = whole.tensors;
  damaged["novelty.state.mean"] = Ones({kState + 1});
  expect_refused(damaged);
  damaged = whole.tensors;
  std::vector<float> ranks = ToFloats(whole.tensors.at("novelty.residual.ranks"));
  std::reverse(ranks.begin(), ranks.end());
  damaged["novelty.residual.ranks"] = HalfTensor({static_cast<std::int64_t>(ranks.size())}, ranks);
  expect_refused(damaged);
}

}  // namespace
}  // namespace prospect::model

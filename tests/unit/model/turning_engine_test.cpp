// Looking at a picture in several of its turns: the mean of what the networks say of each.
#include "model/turning_engine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/calibration.h"
#include "model/novelty.h"
#include "model/turns.h"
#include "tests/unit/model/made_weights.h"
#include "tests/unit/model/small_config.h"

namespace prospect::model {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr float kRounding = 1e-5F;

/// What was at (x, y) goes to (y, side - 1 - x): a quarter turn to the left.
Bytes QuarterTurn(const Bytes& picture, int side) {
  Bytes turned(picture.size());
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      for (int c = 0; c < 3; ++c)
        turned[static_cast<std::size_t>(((side - 1 - x) * side + y) * 3 + c)] =
            picture[static_cast<std::size_t>((y * side + x) * 3 + c)];
    }
  }
  return turned;
}

Bytes Mirrored(const Bytes& picture, int side) {
  Bytes mirrored(picture.size());
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      for (int c = 0; c < 3; ++c)
        mirrored[static_cast<std::size_t>((y * side + side - 1 - x) * 3 + c)] =
            picture[static_cast<std::size_t>((y * side + x) * 3 + c)];
    }
  }
  return mirrored;
}

/// After actions 0 and 1 from the picture.
Prediction AfterTwo(Engine& engine, const Bytes& picture) {
  const Hidden h0 = engine.Encode(picture);
  const Prediction first = engine.Expand({{h0, h0, 0}}).front();
  return engine.Expand({{h0, first.h, 1}}).front();
}

void ExpectNear(const Prediction& a, const Prediction& b) {
  EXPECT_NEAR(a.value, b.value, kRounding);
  EXPECT_NEAR(a.done, b.done, kRounding);
  ASSERT_EQ(a.q.size(), b.q.size());
  for (std::size_t i = 0; i < a.q.size(); ++i) {
    EXPECT_NEAR(a.q[i], b.q[i], kRounding);
    EXPECT_NEAR(a.p[i], b.p[i], kRounding);
  }
}

class Turning : public ::testing::Test {
 protected:
  Turning() : weights_(SmallConfig(), true, {{"augment", "dihedral"}}) {
    plain_ = LoadEngine(weights_.path, 1);
    side_ = plain_->info().image_width;
    picture_ = Picture(plain_->info(), 3);
  }
  std::unique_ptr<Engine> Looking(int turns) const {
    return std::make_unique<TurningEngine>(LoadEngine(weights_.path, 1), turns);
  }

  MadeWeights weights_;
  std::unique_ptr<Engine> plain_;
  int side_ = 0;
  Bytes picture_;
};

TEST_F(Turning, SaysTheMeanOfWhatIsSaidOfEachTurn) {
  const Prediction upright = AfterTwo(*plain_, picture_);
  const Prediction turned = AfterTwo(*plain_, QuarterTurn(picture_, side_));
  ASSERT_GT(std::abs(upright.value - turned.value), 10 * kRounding) << "nothing to average";
  Prediction mean = upright;
  mean.value = (upright.value + turned.value) / 2;
  mean.done = (upright.done + turned.done) / 2;
  for (std::size_t i = 0; i < mean.q.size(); ++i) {
    mean.q[i] = (upright.q[i] + turned.q[i]) / 2;
    mean.p[i] = (upright.p[i] + turned.p[i]) / 2;
  }
  const auto two = Looking(2);
  ExpectNear(AfterTwo(*two, picture_), mean);
  EXPECT_EQ(two->info().turns, 2);
  EXPECT_EQ(two->info().hidden_size, 2 * plain_->info().hidden_size);
  EXPECT_NE(two->fingerprint(), plain_->fingerprint());
}

TEST_F(Turning, AllEightSayTheSameOfATurnedPicture) {
  const auto eight = Looking(8);
  const Prediction upright = AfterTwo(*eight, picture_);
  ExpectNear(AfterTwo(*eight, QuarterTurn(picture_, side_)), upright);
  ExpectNear(AfterTwo(*eight, Mirrored(picture_, side_)), upright);
}

TEST_F(Turning, PicturesAndTheirNoveltyAreThoseOfThePictureAsItIs) {
  const auto eight = Looking(8);
  EXPECT_EQ(eight->Decode({eight->Encode(picture_)}), plain_->Decode({plain_->Encode(picture_)}));
  EXPECT_EQ(TakeNoveltySample(*eight, picture_).state, plain_->Encode(picture_));
}

TEST_F(Turning, IsStoredWithTheWeightsAndEndsWhatWasCalibratedWithout) {
  Calibration calibration;
  calibration.refusal_threshold = 0.3;
  StoreCalibration(weights_.path, calibration);
  StoreTurns(weights_.path, 1);
  EXPECT_EQ(CalibrationsOf(weights_.path).at(0).refusal_threshold, 0.3) << "nothing changed";
  StoreTurns(weights_.path, 8);
  EXPECT_TRUE(CalibrationsOf(weights_.path).empty());
  EXPECT_EQ(TurnsOf(weights_.path), 8);
  EXPECT_EQ(LoadSearchEngine(weights_.path, 1)->info().turns, 8);
  EXPECT_EQ(LoadEngine(weights_.path, 1)->info().turns, 1) << "the networks themselves";
}

TEST_F(Turning, IsRefusedWhereTheNetworksNeverSawTurnedPictures) {
  const MadeWeights upright(SmallConfig());
  EXPECT_THROW(StoreTurns(upright.path, 8), WeightsError);
  EXPECT_EQ(TurnsOf(upright.path), 1);
  WeightsFile file = ReadWeights(weights_.path);
  for (const auto& turns : {nlohmann::json(9), nlohmann::json("eight")}) {
    file.metadata["turns"] = turns;
    WriteWeights(weights_.path, file.tensors, file.metadata);
    EXPECT_THROW(LoadSearchEngine(weights_.path, 1), WeightsError) << turns;
  }
}

}  // namespace
}  // namespace prospect::model

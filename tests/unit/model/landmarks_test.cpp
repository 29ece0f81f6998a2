#include "model/training/landmarks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "model/training/context.h"
#include "model/training/picture_cache.h"
#include "tests/unit/model/made_trial.h"

namespace prospect::model {
namespace {

constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();

// One frame whose landmarks are the points given.
SampleSet FrameWith(const std::vector<float>& uv) {
  SampleSet set;
  set.frames.push_back({0, 0});
  set.num_landmarks = static_cast<int>(uv.size() / 2);
  set.landmarks = uv;
  return set;
}

TEST(LandmarkMaps, APointInTheMiddleOfACellIsThatCell) {
  const SampleSet set = FrameWith({2.5F / 4, 0.5F / 4});
  const torch::Tensor map = LandmarkMaps(set, {0}, {0}, 4, 4);
  EXPECT_FLOAT_EQ((map[0][0][0][2].item<float>()), 1.0F);
  EXPECT_FLOAT_EQ(map.sum().item<float>(), 1.0F);
}

TEST(LandmarkMaps, APointBetweenCellsIsSharedByNearness) {
  const SampleSet set = FrameWith({0.5F + 0.25F / 4 - 0.125F, 0.5F});
  const torch::Tensor map = LandmarkMaps(set, {0}, {0}, 4, 4);
  EXPECT_FLOAT_EQ((map[0][0][1][1].item<float>()), 0.5F * 0.75F);
  EXPECT_FLOAT_EQ((map[0][0][2][2].item<float>()), 0.5F * 0.25F);
  EXPECT_FLOAT_EQ(map.sum().item<float>(), 1.0F);
}

TEST(LandmarkMaps, WhatIsNotInTheSceneHasNoWeightAndTheEdgeKeepsIts) {
  const SampleSet set = FrameWith({kNowhere, kNowhere, 0.0F, 1.02F});
  const torch::Tensor map = LandmarkMaps(set, {0}, {0}, 4, 4);
  EXPECT_EQ(map[0][0].sum().item<float>(), 0.0F);
  EXPECT_FLOAT_EQ((map[0][1][3][0].item<float>()), 1.0F);
}

// The labels of a turned picture are where the turned pixels are: a picture with one bright pixel
// whose place is the landmark.
TEST(LandmarkMaps, TurnWithTheirPictures) {
  const SampleSet set = FrameWith({(1 + 0.5F) / 8, (6 + 0.5F) / 8});
  torch::Tensor picture = torch::zeros({1, 1, 8, 8});
  picture[0][0][6][1] = 1.0F;
  for (int turn = 0; turn < 8; ++turn) {
    const torch::Tensor turned = MovedAsView(picture, std::vector<int>{turn});
    EXPECT_TRUE(torch::allclose(LandmarkMaps(set, {0}, {turn}, 8, 8), turned)) << turn;
  }
}

TEST(LandmarkLoss, IsLowestWhereTheMapsAre) {
  const SampleSet set = FrameWith({0.1F, 0.1F});
  const torch::Tensor map = LandmarkMaps(set, {0}, {0}, 4, 4);
  const torch::Tensor right = map * 20 - 10;
  EXPECT_LT(LandmarkLoss(right, map).item<float>(), 0.5F);
  EXPECT_GT(LandmarkLoss(right.flip({3}), map).item<float>(), 0.5F);
}

TEST(Samples, LandmarksAreThoseOfTheirFrames) {
  Trial trial = MadeTrial(4);
  trial.landmarks.clear();
  for (int i = 0; i < trial.frames(); ++i) {
    trial.landmarks.push_back(static_cast<float>(i));
    trial.landmarks.push_back(-static_cast<float>(i));
  }
  SampleSet set;
  AddTrial(trial, 0, 1, &set);
  ASSERT_EQ(set.landmarks.size(), set.frames.size() * 2);
  for (std::size_t slot = 0; slot < set.frames.size(); ++slot) {
    EXPECT_EQ(set.landmarks[2 * slot], static_cast<float>(set.frames[slot].frame));
    EXPECT_EQ(set.landmarks[2 * slot + 1], -static_cast<float>(set.frames[slot].frame));
  }
}

TEST(Samples, TrialsWithAndWithoutLandmarksMayBeMixed) {
  Trial silent = MadeTrial(5);
  silent.num_landmarks = 0;
  silent.landmarks.clear();
  const Trial telling = MadeTrial(4);
  ASSERT_GT(telling.num_landmarks, 0);
  for (const bool silent_first : {true, false}) {
    SampleSet set;
    AddTrial(silent_first ? silent : telling, 0, 1, &set);
    AddTrial(silent_first ? telling : silent, 1, 1, &set);
    ASSERT_EQ(set.num_landmarks, telling.num_landmarks);
    const auto row = static_cast<std::size_t>(set.num_landmarks) * 2;
    ASSERT_EQ(set.landmarks.size(), set.frames.size() * row);
    for (std::size_t slot = 0; slot < set.frames.size(); ++slot) {
      const bool says = (set.frames[slot].trial == 0) != silent_first;
      EXPECT_NE(std::isinf(set.landmarks[slot * row]), says) << slot;
    }
  }
}

TEST(LandmarkLoss, AsksNothingWhereNothingIsKnown) {
  const float infinite = std::numeric_limits<float>::infinity();
  const SampleSet set = FrameWith({infinite, infinite});
  const torch::Tensor map = LandmarkMaps(set, {0}, {0}, 4, 4);
  const torch::Tensor logits = torch::randn({1, 1, 4, 4}).requires_grad_(true);
  const torch::Tensor loss = LandmarkLoss(logits, map).sum();
  EXPECT_EQ(loss.item<float>(), 0.0F);
  loss.backward();
  EXPECT_EQ(logits.grad().abs().sum().item<float>(), 0.0F);
}

TEST(LightGain, FindsTheFactorWhateverThePictureIs) {
  const torch::Tensor decoded = torch::rand({3, 3, 8, 8});
  const torch::Tensor light = torch::tensor({0.9F, 1.0F, 1.1F}).view({3, 1, 1, 1});
  EXPECT_TRUE(torch::allclose(LightGain(decoded * light, decoded), light, 1e-4));
}

TEST(ComposePicture, ShowsWhatWasSeenWhereNothingChangesAndPaintsTheRestInItsLight) {
  const torch::Tensor decoded_start = torch::full({1, 3, 4, 4}, 0.5F);
  const torch::Tensor seen = decoded_start * 1.1F;
  torch::Tensor decoded = decoded_start + 0.05F;  // less than counts as a change
  decoded.select(3, 0).fill_(0.1F);
  const torch::Tensor picture = ComposePicture(seen, decoded_start, decoded);
  EXPECT_TRUE(torch::allclose(picture.narrow(3, 2, 2), seen.narrow(3, 2, 2)));
  const torch::Tensor beside = torch::full({1, 3, 4}, 0.605F);  // touches the change: painted
  EXPECT_TRUE(torch::allclose(picture.select(3, 1), beside, 1e-4));
  EXPECT_TRUE(torch::allclose(picture.select(3, 0), torch::full({1, 3, 4}, 0.11F), 1e-4));
  // Whatever scale the decoder paints on.
  EXPECT_TRUE(torch::allclose(ComposePicture(seen, decoded_start * 0.3F, decoded * 0.3F), picture));
}

TEST(RelightPicture, IsTheDecodedOneInTheLightOfWhatWasSeen) {
  const torch::Tensor decoded_start = torch::full({1, 3, 4, 4}, 0.5F);
  const torch::Tensor decoded = torch::full({1, 3, 4, 4}, 0.55F);
  const torch::Tensor seen = decoded_start * 1.1F;
  const torch::Tensor picture = RelightPicture(seen, decoded_start, decoded);
  EXPECT_TRUE(torch::allclose(picture, torch::full({1, 3, 4, 4}, 0.605F), 1e-4));
  EXPECT_TRUE(ImaginedPicture(seen, decoded_start, decoded, false).equal(picture));
  EXPECT_TRUE(ImaginedPicture(seen, decoded_start, decoded, true)
                  .equal(ComposePicture(seen, decoded_start, decoded)));
}

}  // namespace
}  // namespace prospect::model

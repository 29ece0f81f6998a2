#include "model/training/views.h"

#include <gtest/gtest.h>

#include <set>

namespace prospect::model {
namespace {

torch::Tensor Ramp() {  // brighter to the right in red, to the bottom in green
  const torch::Tensor x = torch::linspace(0.1, 0.9, 16).view({1, 1, 1, 16}).expand({1, 1, 12, 16});
  const torch::Tensor y = torch::linspace(0.1, 0.9, 12).view({1, 1, 12, 1}).expand({1, 1, 12, 16});
  return torch::cat({x, y, 0.5 * (x + y)}, 1).contiguous();
}

TEST(View, OfElementZeroIsThePicture) {
  EXPECT_TRUE(View(Ramp(), 0).equal(Ramp()));
  EXPECT_TRUE(View(Ramp(), std::vector<int>{0}).equal(Ramp()));
}

TEST(View, OfOtherCamerasIsLikeThePictureAndNotIt) {
  std::set<float> corners;
  for (int element = kTurns; element < kTurns + 20; ++element) {
    const torch::Tensor view = View(Ramp(), element);
    ASSERT_EQ(view.sizes(), Ramp().sizes());
    EXPECT_LT((view - Ramp()).abs().max().item<float>(), 0.25F);
    EXPECT_GT((view - Ramp()).abs().max().item<float>(), 0.005F);
    EXPECT_LE(view.max().item<float>(), 1.0F);
    EXPECT_GT(view.min().item<float>(), 0.0F) << "beyond the edge is the edge, not black";
    EXPECT_TRUE(view.equal(View(Ramp(), element))) << "a function of the element";
    corners.insert(view[0][0][0][0].item<float>());
  }
  EXPECT_GT(corners.size(), 15U);
}

TEST(View, TintsPicturesAndNotTheirMaps) {
  const torch::Tensor even = torch::full({1, 3, 8, 8}, 0.5F);
  EXPECT_TRUE(torch::allclose(MovedAsView(even, kTurns + 3), even));
  const torch::Tensor view = View(even, kTurns + 3);
  EXPECT_FALSE(torch::allclose(view, even, 1e-3, 1e-3));
  EXPECT_TRUE(torch::allclose(view[0][0], view[0][0][0][0].expand({8, 8})));
}

TEST(View, EachPictureOfABatchIsVariedInItsWay) {
  const torch::Tensor both = torch::cat({Ramp(), Ramp()}, 0);
  const torch::Tensor views = View(both, std::vector<int>{kTurns + 1, kTurns + 2});
  EXPECT_TRUE(views.narrow(0, 0, 1).equal(View(Ramp(), kTurns + 1)));
  EXPECT_TRUE(views.narrow(0, 1, 1).equal(View(Ramp(), kTurns + 2)));
}

TEST(ViewOf, FewVariantsStillShowAllTurns) {
  TrainConfig config;
  EXPECT_EQ(ViewOf(config, 5, 0), 0);
  config.augment = "dihedral";
  std::set<int> turns;
  for (int trial = 0; trial < 8; ++trial) turns.insert(ViewOf(config, trial, 0));
  EXPECT_EQ(turns.size(), 8U);
}

TEST(ViewOf, CamerasKeepThePictureItselfAndDifferByTrial) {
  TrainConfig config;
  config.augment = "camera";
  std::set<int> cameras;
  for (int trial = 0; trial < 20; ++trial) {
    EXPECT_EQ(ViewOf(config, trial, 0), 0);
    const int view = ViewOf(config, trial, 1);
    EXPECT_GE(view, kTurns);
    EXPECT_LT(view, kTurns + kCameras);
    EXPECT_EQ(view, ViewOf(config, trial, 1)) << "all pictures of a trial are varied alike";
    cameras.insert(view);
  }
  EXPECT_GT(cameras.size(), 15U);
}

}  // namespace
}  // namespace prospect::model

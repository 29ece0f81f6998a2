#include "model/training/picture_measures.h"

#include <gtest/gtest.h>

namespace prospect::model {
namespace {

TEST(PictureMeasures, EqualPicturesGetTheMost) {
  const torch::Tensor x = torch::rand({2, 3, 24, 32});
  EXPECT_TRUE(Psnr(x, x).eq(100.0).all().item<bool>());
  EXPECT_TRUE(torch::allclose(Ssim(x, x), torch::ones({2}), 1e-4, 1e-4));
}

TEST(PictureMeasures, PsnrIsTheErrorInDecibels) {
  const torch::Tensor x = torch::full({1, 3, 16, 16}, 0.5);
  EXPECT_NEAR(Psnr(x, x + 0.1).item<double>(), 20.0, 1e-4);
  EXPECT_NEAR(Psnr(x, x - 0.01).item<double>(), 40.0, 1e-3);
}

// Of flat pictures only the means count: (2ab + C1) / (a^2 + b^2 + C1).
TEST(PictureMeasures, SsimOfFlatPictures) {
  const torch::Tensor a = torch::full({1, 3, 16, 20}, 0.4), b = torch::full({1, 3, 16, 20}, 0.6);
  EXPECT_NEAR(Ssim(a, b).item<double>(), (0.48 + 1e-4) / (0.52 + 1e-4), 1e-3);
}

// Opposite patterns of equal mean: the covariance is minus the variance.
TEST(PictureMeasures, SsimTellsStructureWhereTheErrorDoesNot) {
  torch::Tensor pattern = torch::zeros({1, 3, 32, 32});
  pattern.slice(3, 0, 32, 2).fill_(0.2);
  const torch::Tensor a = pattern + 0.4, b = 0.6 - pattern;
  const double shifted = Ssim(a, a + 0.1).item<double>(), opposite = Ssim(a, b).item<double>();
  EXPECT_GT(shifted, 0.9);
  EXPECT_LT(opposite, -0.7);
}

TEST(PictureMeasures, PicturesOfABatchDoNotMix) {
  const torch::Tensor x = torch::rand({3, 3, 16, 16}), y = torch::rand({3, 3, 16, 16});
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(Ssim(x, y)[i].item<double>(),
                Ssim(x.narrow(0, i, 1), y.narrow(0, i, 1)).item<double>(), 1e-5);
    EXPECT_NEAR(Psnr(x, y)[i].item<double>(),
                Psnr(x.narrow(0, i, 1), y.narrow(0, i, 1)).item<double>(), 1e-4);
  }
}

}  // namespace
}  // namespace prospect::model

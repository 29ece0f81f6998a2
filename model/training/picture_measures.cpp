#include "model/training/picture_measures.h"

namespace prospect::model {
namespace {

constexpr double kLeastError = 1e-10;  // mean squared; 100 dB
constexpr int kWindow = 11;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;  // of a range of 1

/// [1,1,kWindow,kWindow], sum 1.
torch::Tensor Window(const torch::TensorOptions& options) {
  const torch::Tensor at = torch::arange(kWindow, options) - (kWindow - 1) / 2;
  const torch::Tensor line = torch::exp(at.square() / (-2.0 * kSigma * kSigma));
  const torch::Tensor square = line.unsqueeze(0) * line.unsqueeze(1);
  return (square / square.sum()).view({1, 1, kWindow, kWindow});
}

}  // namespace

torch::Tensor Psnr(const torch::Tensor& x, const torch::Tensor& goal) {
  const torch::Tensor error = (x - goal).square().mean({1, 2, 3}).clamp_min(kLeastError);
  return torch::log10(error) * -10.0;
}

torch::Tensor Ssim(const torch::Tensor& x, const torch::Tensor& goal) {
  const torch::Tensor window = Window(x.options());
  const auto mean = [&](const torch::Tensor& picture) {
    return torch::conv2d(picture.reshape({-1, 1, picture.size(2), picture.size(3)}), window);
  };
  const torch::Tensor mx = mean(x), my = mean(goal);
  const torch::Tensor vx = mean(x * x) - mx * mx, vy = mean(goal * goal) - my * my;
  const torch::Tensor cov = mean(x * goal) - mx * my;
  const torch::Tensor likeness =
      (2 * mx * my + kC1) * (2 * cov + kC2) / ((mx * mx + my * my + kC1) * (vx + vy + kC2));
  return likeness.view({x.size(0), -1}).mean(1);
}

}  // namespace prospect::model

#include "model/training/landmarks.h"

#include <algorithm>
#include <cmath>

#include "model/networks/blocks.h"

namespace prospect::model {
namespace {

constexpr double kRare = 4.0;  // logit of a landmark in any one of some 60 cells

constexpr float kNotKnown = -1.0F;  // in a map: nobody says whether the landmark is there

struct Point {
  float u, v;
};

/// Where a point of the picture goes when it is turned by View(element).
Point Turned(Point p, int element) {
  if (element >= 4) p.u = 1 - p.u;
  for (int k = 0; k < element % 4; ++k) p = {p.v, 1 - p.u};
  return p;
}

/// Adds weight 1 around column u, row v (in picture sizes) to a map.
void Splat(Point p, std::int64_t height, std::int64_t width, float* map) {
  const auto at = [](float x, std::int64_t n) {
    return std::clamp(x * static_cast<float>(n) - 0.5F, 0.0F, static_cast<float>(n - 1));
  };
  const float x = at(p.u, width), y = at(p.v, height);
  const auto x0 = static_cast<std::int64_t>(x), y0 = static_cast<std::int64_t>(y);
  for (std::int64_t j = y0; j <= std::min(y0 + 1, height - 1); ++j) {
    for (std::int64_t i = x0; i <= std::min(x0 + 1, width - 1); ++i) {
      map[j * width + i] +=
          (1 - std::abs(x - static_cast<float>(i))) * (1 - std::abs(y - static_cast<float>(j)));
    }
  }
}

}  // namespace

LandmarkReadoutImpl::LandmarkReadoutImpl(int channels, int landmarks, double scale)
    : scale_(scale) {
  conv_ = register_module("conv", torch::nn::Conv2d(channels, landmarks, 1));
  InitialiseGlorot(this);
}

torch::Tensor LandmarkReadoutImpl::forward(const torch::Tensor& features) {
  return conv_->forward((features - 0.5) * scale_) - kRare;
}

torch::Tensor LandmarkMaps(const SampleSet& samples, const std::vector<int>& slots,
                           const std::vector<int>& turns, std::int64_t height, std::int64_t width) {
  const auto count = static_cast<std::size_t>(samples.num_landmarks);
  torch::Tensor maps = torch::zeros({static_cast<int64_t>(slots.size()),
                                     static_cast<int64_t>(samples.num_landmarks), height, width});
  float* out = maps.data_ptr<float>();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    for (std::size_t k = 0; k < count; ++k, out += height * width) {
      const float* uv = &samples.landmarks[(static_cast<std::size_t>(slots[i]) * count + k) * 2];
      if (std::isinf(uv[0])) std::fill_n(out, height * width, kNotKnown);
      if (std::isfinite(uv[0])) Splat(Turned({uv[0], uv[1]}, turns[i]), height, width, out);
    }
  }
  return maps;
}

torch::Tensor LandmarkLoss(const torch::Tensor& logits, const torch::Tensor& maps) {
  const torch::Tensor known = maps.ge(0).to(maps.scalar_type());
  return torch::binary_cross_entropy_with_logits(logits, maps, known, {}, at::Reduction::None)
      .mean({1, 2, 3});
}

}  // namespace prospect::model

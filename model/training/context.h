#pragma once

#include <string>
#include <vector>

#include "model/networks/light.h"
#include "model/networks/networks.h"
#include "model/training/landmarks.h"
#include "model/training/picture_cache.h"
#include "model/training/samples.h"
#include "model/training/train_config.h"
#include "model/training/views.h"

namespace prospect::model {

/// What all stages share. A view: whoever makes it keeps everything alive. `hidden` is null until
/// the encoder is trained. Stages only read it, except for the weights of the networks that they
/// train.
struct TrainContext {
  const TrainConfig& config;
  const SampleSet& samples;
  const PictureCache& pictures;
  const HiddenCache* hidden;
  Networks networks;
  torch::Device device;
  torch::Tensor mean_picture;          ///< [3,H,W] of training frames, on the device
  LandmarkReadout landmarks{nullptr};  ///< trained with the encoder; null: no such labels

  /// How variant `variant` of a trial's pictures is varied: ViewOf.
  int ViewOf(int trial_index, int variant) const {
    return model::ViewOf(config, trial_index, variant);
  }

  const TrialSample& trial(int i) const { return samples.trials[static_cast<std::size_t>(i)]; }
  const SegmentSample& segment(int i) const {
    return samples.segments[static_cast<std::size_t>(i)];
  }
};

/// Weights of pixels for the picture losses: 1 + focus where a pixel of `x` [B,3,H,W] differs from
/// the mean picture by 0.18 or more in some channel, 1 below 0.08, linear between; [B,1,H,W].
/// (Below 0.08 lies the light that changes from trial to trial.) focus = 0 gives ones.
torch::Tensor PixelWeights(const torch::Tensor& x, const torch::Tensor& mean_picture, double focus);

/// "cpu" or "cuda". Throws std::invalid_argument where libtorch finds no GPU.
torch::Device DeviceNamed(const std::string& name);

/// Indices of actions as a tensor [n] int64 on `device`.
torch::Tensor ActionTensor(const std::vector<int>& actions, const torch::Device& device);
/// Floats as a tensor [n] on `device`.
torch::Tensor FloatTensor(const std::vector<float>& values, const torch::Device& device);

}  // namespace prospect::model

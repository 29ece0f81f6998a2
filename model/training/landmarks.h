#pragma once

#include <torch/torch.h>

#include <vector>

#include "model/training/samples.h"

namespace prospect::model {

/// Beyond the paper: reads from a map of features where the scene's landmarks are (robot, objects;
/// sim::Task::Landmarks). An encoder trained only to give its picture back spreads what it knows
/// over all its numbers; trained with this readout it keeps places where a linear map finds them,
/// and T and the heads then learn from a tenth of the samples. Only training uses it: it needs
/// labels that a simulator has and a robot has not, and is left out where they are missing.
class LandmarkReadoutImpl : public torch::nn::Module {
 public:
  /// @param scale brings the features to about unit variance: kHiddenScale for hidden states, which
  /// lie in [0,1], 1 behind a normalisation. Without it the readout learns too slowly to be of use.
  LandmarkReadoutImpl(int channels, int landmarks, double scale);
  static constexpr double kHiddenScale = 10.0;
  /// Features [B,channels,Hh,Wh] to logits [B,landmarks,Hh,Wh]: is the landmark in this cell?
  torch::Tensor forward(const torch::Tensor& features);

 private:
  double scale_;
  torch::nn::Conv2d conv_{nullptr};
};
TORCH_MODULE(LandmarkReadout);

/// Where the landmarks of frames `slots` are, on a grid [B,K,height,width]: each has weight 1
/// shared by the four cells around it, in proportion to nearness; none has weight if it is not in
/// the scene. The whole map is -1 where the trial does not say where things are. Pictures are
/// turned by View(turns[i]).
torch::Tensor LandmarkMaps(const SampleSet& samples, const std::vector<int>& slots,
                           const std::vector<int>& turns, std::int64_t height, std::int64_t width);

/// Binary cross-entropy of the logits against the maps, a mean for each of the B pictures; maps of
/// -1 add nothing and pull nowhere.
torch::Tensor LandmarkLoss(const torch::Tensor& logits, const torch::Tensor& maps);

}  // namespace prospect::model

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "model/inference/layers.h"
#include "model/network_config.h"

namespace prospect::model::inference {

/// A question about one state. Hidden states lie pixel by pixel here.
struct StateRow {
  const float* h = nullptr;     ///< the state
  const float* root = nullptr;  ///< what FoldRoot made of h0
  int action = 0;               ///< 0..num_actions (T: num_actions - 1)
};

/// T(h0, h, a) to h' (model/networks/transform.h). What depends on h0 alone is computed once a
/// root, what depends on the action alone when the weights are loaded; neither is computed
/// otherwise, so answers do not depend on what is remembered. Immutable; an arena a thread.
class Transform {
 public:
  Transform(const Kernels& kernels, const TensorReader& reader, const NetworkConfig& config);

  std::size_t root_size() const { return merge_root_->out_size(); }
  /// h0's half of the merging convolution.
  void FoldRoot(const float* h0, float* root, Arena& arena) const;

  /// `count` states to as many at `next`, one after the other.
  void Run(const StateRow* rows, int count, float* next, Arena& arena) const;

 private:
  /// What an action adds, by the place it is added at.
  struct ActionPart {
    std::vector<float> tiled;       // rows of 64 for with_action's kinds of pixels
    std::vector<float> dense;       // what dense begins from (soft argmax)
    std::vector<float> modulation;  // 128 a modulated layer, in the order they are run; or empty
  };
  struct Stage {
    std::optional<NormedBlock> down;  // from the stage before; none in the first
    std::optional<NormedBlock> up, join;
  };

  void ReadActions(const TensorReader& reader);
  void AddTiled(const ConvolutionWeights& half);
  void ReadBottleneck(const TensorReader& reader);
  void ReadStages(const TensorReader& reader);

  const float* Modulation(const StateRow& row, int layer) const;
  void Finish(const NormedBlock& block, const StateRow* rows, int count, int layer,
              float* maps) const;
  void Merge(const StateRow* rows, int count, float* features, Arena& arena) const;
  void Squeeze(const StateRow* rows, int count, const float* features, float* squeezed,
               Arena& arena) const;
  void SoftArgmax(const StateRow* rows, int count, const float* features, float* squeezed,
                  Arena& arena) const;
  void Join(const Stage& stage, const float* up, const float* skip, int count, float* out,
            Arena& arena) const;
  void Output(const StateRow* rows, int count, const float* features, float* next,
              Arena& arena) const;

  const Kernels& kernels_;
  NetworkConfig config_;
  Grid grid_, deepest_;
  std::vector<std::vector<float>> action_vectors_;
  std::vector<ActionPart> actions_;
  std::vector<std::int32_t> tiled_row_;  // of each pixel
  std::optional<NormedBlock> from_h_, from_h0_, merge_, with_action_, strided_, small_;
  std::unique_ptr<Convolution> merge_root_;
  std::optional<PackedMatrix> dense_;  // of the positions; the action's part is in ActionPart
  std::vector<Stage> stages_;
  std::optional<BiasedBlock> out_;  // and the mask, as more channels
};

}  // namespace prospect::model::inference

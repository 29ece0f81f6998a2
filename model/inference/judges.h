#pragma once

#include <optional>
#include <vector>

#include "model/inference/layers.h"
#include "model/inference/transform.h"
#include "model/network_config.h"

namespace prospect::model::inference {

/// Q, p or f of (h0, h, a) (model/networks/action_head.h), folded as T is. Immutable; an arena a
/// thread.
class ActionHead {
 public:
  ActionHead(const Kernels& kernels, const TensorReader& reader, const std::string& name,
             const NetworkConfig& config, int outputs);

  std::size_t root_size() const { return conv1_->out_size(); }
  /// What h0 adds to the first common convolution.
  void FoldRoot(const float* h0, float* root, Arena& arena) const;

  /// Probabilities of `count` states, outputs() each; a row's `root` is this head's.
  void Run(const StateRow* rows, int count, float* answers, Arena& arena) const;
  int outputs() const { return out_->outputs(); }

 private:
  void ReadActions(const TensorReader& reader, const std::string& name, const BlockTensors& conv1,
                   const NetworkConfig& config);

  const Kernels& kernels_;
  std::optional<BiasedBlock> from_h_, from_h0_, conv2_;
  std::unique_ptr<Convolution> conv1_, conv1_root_;
  std::optional<PackedMatrix> dense1_;
  std::optional<Dense> dense2_, out_;
  // By action, num_actions standing for none: what it and the biases add to conv1 and dense1.
  std::vector<std::vector<float>> conv1_base_, dense1_base_;
};

/// V(h) (model/networks/value_head.h). Immutable; an arena a thread.
class ValueHead {
 public:
  ValueHead(const Kernels& kernels, const TensorReader& reader, const NetworkConfig& config);
  /// Probabilities of `count` states that lie one after the other.
  void Run(const float* states, int count, float* answers, Arena& arena) const;

 private:
  const Kernels& kernels_;
  std::optional<BiasedBlock> conv0_, conv1_, conv2_;
  std::optional<Dense> dense_, out_;
};

}  // namespace prospect::model::inference

#pragma once

#include <string>
#include <vector>

#include "model/network_config.h"
#include "model/networks/action_head.h"
#include "model/networks/classifier.h"
#include "model/networks/decoder.h"
#include "model/networks/encoder.h"
#include "model/networks/transform.h"
#include "model/networks/value_head.h"

namespace prospect::model {

/// All networks of one task. Copying shares the modules. Threads as libtorch's modules.
struct Networks {
  explicit Networks(const NetworkConfig& config);

  NetworkConfig config;
  Encoder encoder;
  Decoder decoder;
  Transform transform;
  ValueHead value;
  ActionHead q, p, f;
  Classifier classifier;         ///< C: in the loss and in the label accuracy
  bool has_classifier = true;    ///< false: from weights without C, which only training needs
  Classifier second_classifier;  ///< of another seed, in no loss: reads the label accuracy
  /// False: nobody reads labels (TrainConfig::classifier without iterations).
  bool has_second_classifier = true;
  /// False: without V, Q, p and f, which need failures to learn from (TrainConfig::heads without
  /// iterations); such weights predict pictures only.
  bool has_heads = true;

  /// Every network with the prefix its tensors have in a weights file, e.g. {"encoder", ...}, also
  /// those that the has_ flags say are not there.
  std::vector<std::pair<std::string, torch::nn::Module*>> named() const;
  /// What the has_ flags say of a network of named().
  bool Has(const std::string& name) const;
  void SetTraining(bool on) const;
  void To(const torch::Device& device) const;
};

/// True of "value", "q", "p" and "f".
bool IsHead(const std::string& name);

/// Number of learned values in a module.
int64_t ParameterCount(const torch::nn::Module& module);

}  // namespace prospect::model

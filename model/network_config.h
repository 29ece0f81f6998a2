#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace prospect::model {

/// Everything the shapes and layers of the networks depend on: one struct for all tasks, stored
/// with the weights. The defaults are the paper's text (§III-A, III-B); where the text is silent,
/// the authors' code. A plain value.
struct NetworkConfig {
  int image_width = 64;     ///< pixels, a multiple of 16, at least 32
  int image_height = 64;    ///< pixels, a multiple of 16, at least 32
  int hidden_channels = 8;  ///< channels of h; its grid is the image's divided by 8
  int num_actions = 7;      ///< size of the action table; the null action is index num_actions
  double dropout =
      0.1;  ///< after blocks of encoder, decoder, transform (paper), and in C's convolutions
  double transform_dropout = -1;  ///< T's own where it is to differ; negative: `dropout`
  double head_dropout = 0.5;  ///< in V, Q, p, f and C's dense layers (authors' code; paper silent)
  std::string activation =
      "relu";  ///< encoder and T's action layer: "relu" (paper) or "leaky_relu" (code)
  std::string heads =
      "paper";  ///< Q, p, f: "paper" (1x1 convolutions, FC256-FC128) or "costar" (4x4, 128-128)
  bool skip = true;  ///< T's connection across the bottleneck
  /// What T squeezes its features through: "soft_argmax" (paper) or "strided" (its U-net
  /// comparison).
  std::string bottleneck = "soft_argmax";
  /// How T is told the action: "bottleneck" (paper) only, or also as "scale_and_shift" of every
  /// layer's channels (Perez et al. 2018).
  std::string transform_action = "bottleneck";
  /// Beyond the paper: a learned mask keeps numbers of h in T's result, so that what an action
  /// leaves alone need not be made anew from normalised features.
  bool transform_mask = false;
  int transform_extra_stages =
      0;  ///< T's extra stages of 64 channels with their own skip (suturing: 1)

  double dropout_of_transform() const {
    return transform_dropout < 0 ? dropout : transform_dropout;
  }
  int hidden_height() const { return image_height / 8; }
  int hidden_width() const { return image_width / 8; }
  /// Floats in one hidden state, hidden_channels x hidden_height x hidden_width (channel major).
  int hidden_size() const { return hidden_channels * hidden_height() * hidden_width(); }
  int image_bytes() const { return image_width * image_height * 3; }
};

/// Throws std::invalid_argument naming the field that is out of range.
void Validate(const NetworkConfig& config);

void to_json(nlohmann::json& json, const NetworkConfig& config);
/// Missing keys keep their defaults; unknown keys and wrong types throw std::invalid_argument.
void from_json(const nlohmann::json& json, NetworkConfig& config);

}  // namespace prospect::model

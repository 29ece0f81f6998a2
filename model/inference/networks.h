#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/inference/judges.h"
#include "model/inference/picture_networks.h"
#include "model/inference/transform.h"
#include "model/weights_file.h"

namespace prospect::model::inference {

/// What depends on a problem's first state alone, computed once for all questions about it.
struct RootPart {
  std::vector<float> transform, q, p, f;  ///< the heads' are empty where weights hold none
};

/// What the judging networks say of `count` states, one after the other.
struct Judgements {
  std::vector<float> value, done;  ///< one a state
  std::vector<float> q, p;         ///< num_actions a state
};

/// All networks of a weights file, as inference runs them. Hidden states are channel by channel
/// outside, as Engine has them. Immutable; several threads may ask at once, each with an arena of
/// its own. A state's answers do not depend on the states beside it.
class Networks {
 public:
  /// Throws WeightsError naming `path` where a network is missing or damaged.
  Networks(const Kernels& kernels, const WeightsFile& file, const std::string& path);

  const NetworkConfig& config() const { return config_; }
  bool judges() const { return value_.has_value(); }
  bool classifies() const { return classifier_.has_value(); }

  /// A picture, height x width x 3 bytes, to hidden_size numbers.
  void Encode(const std::uint8_t* rgb, float* h, Arena& arena) const;
  /// A state to a picture, height x width x 3 numbers from 0 to 1.
  void Decode(const float* h, float* picture, Arena& arena) const;
  std::vector<float> Classify(const std::uint8_t* rgb, Arena& arena) const;

  RootPart FoldRoot(const float* h0, Arena& arena) const;

  struct Question {
    const float* h;
    const RootPart* root;
    int action;
  };
  /// T, then the judges of what it gives. `next` gets hidden_size numbers a question.
  void Expand(std::span<const Question> questions, float* next, Judgements* judgements,
              Arena& arena) const;
  /// The judges of the states that the questions hold.
  void Judge(std::span<const Question> questions, Judgements* judgements, Arena& arena) const;

 private:
  void JudgeStates(std::span<const Question> questions, const float* states, Judgements* judgements,
                   Arena& arena) const;
  std::size_t hidden_size() const { return static_cast<std::size_t>(config_.hidden_size()); }
  int hidden_pixels() const { return config_.hidden_height() * config_.hidden_width(); }

  NetworkConfig config_;
  Encoder encoder_;
  Decoder decoder_;
  Transform transform_;
  std::optional<ValueHead> value_;
  std::optional<ActionHead> q_, p_, f_;
  std::optional<Classifier> classifier_;
};

}  // namespace prospect::model::inference

#pragma once

#include "model/engine.h"

namespace prospect::model {

/// The tree a ScriptedEngine pretends to have learned.
struct ScriptedOptions {
  std::string task = "scripted";  ///< what it says it was trained for
  int num_actions = 7;
  int offered_actions = 4;      ///< p allows the first so many actions, and not the one just done
  double failing_share = 0.25;  ///< share of imagined actions that fail (done = 0.02)
  std::uint64_t seed = 1;       ///< which tree
  int image_width = 64, image_height = 64;
  double refusal_threshold = 0.0;
  std::vector<CalibrationSample> calibrations{};  ///< as if they had come with weights
};

/// An engine without networks, for tests of everything around them: a hidden state is a hash of the
/// actions since the root, and every answer a pure function of it. A child of one parent differs
/// from its sibling; some actions fail; equal paths give equal answers in every process. The
/// picture's content does not matter, only that x0 is one: all roots are the same state, so that
/// sensor noise changes nothing. Thread-safe.
class ScriptedEngine : public Engine {
 public:
  explicit ScriptedEngine(const ScriptedOptions& options = {});

  const EngineInfo& info() const override { return info_; }
  std::uint64_t weights_hash() const override;
  std::uint64_t fingerprint() const override;

 protected:
  Hidden DoEncode(Pixels picture) override;
  Prediction DoEvaluate(std::span<const float> h0, std::span<const float> h,
                        int previous_action) override;
  std::vector<Prediction> DoExpand(const std::vector<ExpandInput>& rows) override;
  /// A plain picture whose colour tells the state.
  std::vector<std::vector<std::uint8_t>> DoDecode(const std::vector<Hidden>& states) override;
  std::vector<float> DoClassify(Pixels picture) override;

 private:
  Prediction Answer(std::uint64_t state, int action, float done) const;

  ScriptedOptions options_;
  EngineInfo info_;
};

}  // namespace prospect::model

#pragma once

#include "model/engine.h"
#include "planner/scripted_tree.h"

namespace prospect::services {

/// planner::ScriptedTree behind the engine's interface, so that a tree whose best plan is known is
/// searched over the bus by the same server and workers as any other. Which tree it is stands in
/// the picture: its first eight bytes are the seed, little end first, so one server serves every
/// seed. A hidden state is the seed and the path. Answers are pure functions; thread-safe.
class ScriptedTreeEngine : public model::Engine {
 public:
  ScriptedTreeEngine();

  const model::EngineInfo& info() const override { return info_; }
  std::uint64_t weights_hash() const override;
  std::uint64_t fingerprint() const override { return weights_hash(); }

  static constexpr char kTask[] = "scripted-tree";
  static constexpr int kImageSize = 16;  ///< pixels a side

  /// The picture that names tree `seed`.
  static std::vector<std::uint8_t> PictureOf(std::uint64_t seed);

 protected:
  model::Hidden DoEncode(model::Pixels picture) override;
  model::Prediction DoEvaluate(std::span<const float> h0, std::span<const float> h,
                               int previous_action) override;
  std::vector<model::Prediction> DoExpand(const std::vector<model::ExpandInput>& rows) override;
  /// A plain picture whose colour tells the path.
  std::vector<std::vector<std::uint8_t>> DoDecode(
      const std::vector<model::Hidden>& states) override;
  /// None.
  std::vector<float> DoClassify(model::Pixels picture) override;

 private:
  model::EngineInfo info_;
};

}  // namespace prospect::services

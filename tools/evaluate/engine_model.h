#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "model/engine.h"
#include "planner/model_source.h"

namespace prospect::tools {

// The learned networks as the planner's model, inside one process: hidden states are kept by path
// and a node is imagined from its parent's hidden state (the paper's Algorithm 1, T). Not thread
// safe; does not own the engine.
class EngineModel : public planner::ModelSource {
 public:
  explicit EngineModel(model::Engine* engine) : engine_(engine) {}

  // A new episode: x0 of every root that follows. Pictures are RGB of the engine's size.
  void SetFirst(const std::vector<std::uint8_t>& image);
  // A new root: the picture now, and the last action carried out (num_actions for none).
  void SetRoot(const std::vector<std::uint8_t>& image, int previous_action);

  planner::Evaluation Evaluate(const planner::Path& path) override;
  std::vector<planner::Evaluation> EvaluateBatch(const std::vector<planner::Path>& paths) override;

  // All of what the networks say of the node that `path` leads to, its hidden state included. Valid
  // until SetRoot.
  const model::Prediction& Predict(const planner::Path& path);

  // The pictures after `paths`.
  std::vector<std::vector<std::uint8_t>> Imagine(const std::vector<planner::Path>& paths);

  // Networks' answers asked for since the last SetRoot.
  std::int64_t evaluations() const { return evaluations_; }

 private:
  model::Engine* engine_;
  model::Hidden h0_;
  model::Hidden root_;
  std::vector<std::uint8_t> picture_;  // of the root
  int previous_action_ = 0;
  std::map<planner::Path, model::Prediction> known_;
  std::int64_t evaluations_ = 0;
};

}  // namespace prospect::tools

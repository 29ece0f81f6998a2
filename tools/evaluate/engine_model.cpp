#include "tools/evaluate/engine_model.h"

#include <utility>

namespace prospect::tools {
namespace {

planner::Evaluation ToEvaluation(const model::Prediction& prediction) {
  return {prediction.value, prediction.done, prediction.q, prediction.p};
}

}  // namespace

void EngineModel::SetFirst(const std::vector<std::uint8_t>& image) { h0_ = engine_->Encode(image); }

void EngineModel::SetRoot(const std::vector<std::uint8_t>& image, int previous_action) {
  picture_ = image;
  root_ = engine_->Encode(image);
  previous_action_ = previous_action;
  known_.clear();
  evaluations_ = 0;
}

const model::Prediction& EngineModel::Predict(const planner::Path& path) {
  const auto found = known_.find(path);
  if (found != known_.end()) return found->second;
  ++evaluations_;
  if (path.empty()) {
    model::Prediction root = engine_->Evaluate(h0_, root_, previous_action_);
    root.h = root_;
    return known_[path] = std::move(root);
  }
  const model::Prediction& parent = Predict(planner::Path(path.begin(), path.end() - 1));
  std::vector<model::Prediction> made =
      engine_->Expand({model::ExpandInput{h0_, parent.h, path.back()}});
  return known_[path] = std::move(made.front());
}

std::vector<std::vector<std::uint8_t>> EngineModel::Imagine(
    const std::vector<planner::Path>& paths) {
  std::vector<model::Hidden> states;
  for (const planner::Path& path : paths) states.push_back(Predict(path).h);
  return engine_->DecodeOnto(picture_, root_, states);
}

planner::Evaluation EngineModel::Evaluate(const planner::Path& path) {
  return ToEvaluation(Predict(path));
}

std::vector<planner::Evaluation> EngineModel::EvaluateBatch(
    const std::vector<planner::Path>& paths) {
  std::vector<planner::Evaluation> evaluations;
  for (const planner::Path& path : paths) evaluations.push_back(Evaluate(path));
  return evaluations;
}

}  // namespace prospect::tools

#include "tools/evaluate/rule.h"

#include "model/calibration.h"
#include "model/weights_error.h"
#include "planner/search_parameters.h"

namespace prospect::tools {

std::string RuleOf(const std::string& weights, const model::SceneKind& kind) {
  std::string rule;
  try {
    const auto samples = model::SamplesOf(model::CalibrationsOf(weights));
    const model::CalibrationSample* covering = model::CoveringSample(samples, kind);
    if (!samples.empty()) rule = covering != nullptr ? covering->rule : samples.front().rule;
  } catch (const model::WeightsError&) {
    // Whoever loads them says what is wrong.
  }
  return rule.empty() ? planner::SearchParameters().rule : rule;
}

}  // namespace prospect::tools

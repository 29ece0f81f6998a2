#include "tools/evaluate/rule.h"

#include "model/calibration.h"
#include "model/weights_error.h"
#include "planner/search_parameters.h"

namespace prospect::tools {

std::string RuleOf(const std::string& weights) {
  std::string rule;
  try {
    rule = model::CalibrationOf(weights).sample.rule;
  } catch (const model::WeightsError&) {
    // Whoever loads them says what is wrong.
  }
  return rule.empty() ? planner::SearchParameters().rule : rule;
}

}  // namespace prospect::tools

#pragma once

#include <string>

#include "model/refusal/scene_kind.h"

namespace prospect::tools {

// The selection rule by which these weights were calibrated on such scenes, so that their threshold
// holds, or else on others; of weights that were not calibrated, or cannot be read, the planner's
// default.
std::string RuleOf(const std::string& weights, const model::SceneKind& kind);

}  // namespace prospect::tools

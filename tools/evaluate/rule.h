#pragma once

#include <string>

namespace prospect::tools {

// The selection rule by which these weights were calibrated, so that their threshold holds; of
// weights that were not, or cannot be read, the planner's default.
std::string RuleOf(const std::string& weights);

}  // namespace prospect::tools

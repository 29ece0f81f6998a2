#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "planner/path.h"

namespace prospect::services::console {

// Values in what a page sends, which is believed in nothing.

/// A path of a request: an array of whole numbers 0 to 254, at most planner::kMaxPathLength.
/// @throws std::exception
planner::Path PathFrom(const nlohmann::json& value);
/// A search's id: a text of digits. @throws std::exception
std::int64_t IdFrom(const nlohmann::json& value);

}  // namespace prospect::services::console

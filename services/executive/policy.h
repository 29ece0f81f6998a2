#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lcmtypes/messages.h"

namespace prospect::services {

/// Whether `policy` is one of "search", "collect", "expert", "plan:A,B,..." (action indices).
/// @return empty when it is, else what is wrong
std::string PolicyDefect(const std::string& policy);

/// The actions of "plan:A,B,...". Throws std::invalid_argument when it is malformed.
std::vector<int> ParsePlan(const std::string& policy);

/// The plan that `prospect collect` carries out for this scene: random among the actions whose
/// object is on the site and that the task allows, from a stream that the scene's seed alone
/// decides. So that an episode recorded from the bus equals a collected one.
/// @param label of the episode's first picture, for the objects present; none: all may be
/// @param retries false: never go back to try again (policy "expert")
/// Throws std::invalid_argument when label and task disagree on the number of actions.
std::vector<int> CollectPlan(const task_t& task, const std::optional<label_t>& label,
                             std::uint64_t seed, bool retries = true);

}  // namespace prospect::services

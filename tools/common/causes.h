#pragma once

#include <cstdio>
#include <map>
#include <string>

namespace prospect::tools {

// The cause of a failure without its details: "obstacle" of "obstacle(gripper)".
std::string CauseOf(const std::string& reason);

// Counts by cause, from counts by reason.
std::map<std::string, int> ByCause(const std::map<std::string, int>& reasons);

// A line a cause with its share of `trials`, the most frequent first, the reasons within it below
// where there are several.
void PrintCauses(const std::map<std::string, int>& reasons, int trials, std::FILE* out);

}  // namespace prospect::tools

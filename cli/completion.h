#pragma once

#include <string>
#include <vector>

#include "cli/command.h"

namespace prospect::cli {

/// A script for bash that completes commands, their options, and words of which a value must be
/// one; `source <(./prospect completion bash)`.
std::string BashCompletion(const std::vector<Command>& commands);

}  // namespace prospect::cli

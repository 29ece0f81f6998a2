#pragma once

#include <string>

#include "cli/fwd.h"

namespace prospect::cli {

/// Adds --rule: how a search chooses where to look next, by planner/selection_rule.h's names.
CLI::Option* DefineRule(CLI::App& app, std::string& rule);

}  // namespace prospect::cli

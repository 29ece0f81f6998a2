#pragma once

#include <string_view>
#include <vector>

#include "cli/command.h"

namespace prospect::cli {

/// Every command, in the order of the help.
const std::vector<Command>& Commands();

/// The command of exactly this name; nullptr: there is none.
const Command* FindCommand(std::string_view name);

}  // namespace prospect::cli

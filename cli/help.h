#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/command.h"

namespace prospect::cli {

/// Lines of help are at most so long.
inline constexpr std::size_t kHelpColumns = 100;

/// `prospect --help`: every command of the table, grouped.
std::string Overview(const std::vector<Command>& commands);

/// `prospect COMMAND --help`: usage, summary and each option with its range and default.
std::string HelpOf(const CLI::App& app);

/// "--task NAME", "--fresh", "FILE": an option as it is typed.
std::string Spelling(const CLI::Option& option);

}  // namespace prospect::cli

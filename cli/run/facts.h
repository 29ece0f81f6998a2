#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cli/options/report.h"

namespace prospect::cli {

/// What a command says in JSON: names and values.
using ReportFacts = std::vector<std::pair<std::string, std::variant<std::string, int, bool>>>;

/// Writes them as --json asks, if it does. Throws base::DiskError.
void Tell(const ReportOptions& report, const ReportFacts& facts);

/// "1 worker", "2 workers".
std::string Count(int number, const std::string& thing);

}  // namespace prospect::cli

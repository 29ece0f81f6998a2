#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/fwd.h"

namespace prospect::cli {

/// How a closed loop without a bus searches, and when it begins anew.
struct SearchOptions {
  std::int64_t samples = 30;       ///< rollouts a search, of all workers
  int workers = 1;                 ///< that share each search, inside one process
  int depth = 64;                  ///< actions to look ahead; the plan's rest limits it
  std::string rule;                ///< planner/selection_rule.h; empty: as calibrated
  std::optional<double> v_failed;  ///< V below it: given up; left out: as everywhere
  int retries = 1;                 ///< times a plan that is lost may be begun anew
  std::optional<double> surprise;  ///< a larger difference means lost; left out: as everywhere
};

/// Adds --samples, --workers, --depth, --rule, --v-failed, --retries and --surprise.
void DefineSearch(CLI::App& app, SearchOptions& search);

/// Adds --retries and --surprise alone.
void DefineRecovery(CLI::App& app, int& retries, std::optional<double>& surprise);

/// Adds --samples alone.
void DefineSamples(CLI::App& app, std::int64_t& samples);

}  // namespace prospect::cli

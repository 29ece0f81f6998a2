#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "services/bench/search_bench.h"

namespace prospect::services {

// What a bench found, for people and for programs. Pure but for the files.

/// One worker count as a row of figures: sums over runs divided by sums, so that long runs weigh
/// more. Keys: workers, runs, rollouts_per_s, evaluations_per_s, evaluations_per_rollout,
/// mean_batch, batch_share (of the largest batch), compute_share (of the time, that servers
/// computed), optimal_rate, optimal_count, regret, statistics_bytes_per_rollout, bytes_per_rollout,
/// cpu_cores (servers and workers), latency_ms_p50, _p90, _p99, resent_share, converged_share,
/// overhead_ms_p50 (round trip less a batch's mean computing),
/// overshoot (rollouts beyond the budget, mean).
nlohmann::json RowOf(int workers, const std::vector<SearchRun>& runs,
                     const cli::BenchSearchOptions& options);

/// The row's growth against the first row, paired by seed: mean ratio of rollouts/s and its 95 %
/// interval, as keys speedup, speedup_low, speedup_high.
void AddSpeedup(const std::vector<SearchRun>& first, const std::vector<SearchRun>& runs,
                nlohmann::json* row);

std::string TableHead();
std::string TableLine(const nlohmann::json& row);

/// All keys of the rows, one line a row. @throws base::DiskError
void WriteCsv(const std::string& path, const nlohmann::json& rows);

}  // namespace prospect::services

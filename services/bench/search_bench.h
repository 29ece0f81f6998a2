#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/commands/bench.h"
#include "services/bench/crew.h"
#include "services/bench/traffic.h"
#include "services/executive/search_session.h"

namespace prospect::services {

/// One search as measured.
struct SearchRun {
  std::int64_t seed = 0;
  std::int64_t rollouts = 0;
  std::int64_t evaluations = 0;  ///< rows that servers computed
  std::int64_t requested = 0;    ///< evaluations that workers asked for, summed over workers
  std::int64_t batches = 0;
  double seconds = 0;                     ///< from the first answer to the budget's end
  double batch_seconds = 0;               ///< that servers spent computing
  double server_cpu = 0, worker_cpu = 0;  ///< processor seconds
  std::int64_t statistics_bytes = 0, request_bytes = 0, reply_bytes = 0;
  std::int64_t requests = 0, resent = 0, busy = 0;
  double latency_p50 = 0, latency_p90 = 0, latency_p99 = 0;  ///< milliseconds
  double score = 0;
  double optimum = 0;  ///< of the scripted tree
  bool optimal = false;
  bool converged = false;
};

/// Searches over the bus with the real server and worker programs, for growing numbers of workers,
/// over the same seeds. One thread; the conversation must outlive it.
class SearchBench {
 public:
  SearchBench(Conversation& talk, const cli::BenchSearchOptions& options, const std::string& logs);

  /// The searches of one worker count, which must not fall from call to call, with so many
  /// evaluations in flight a worker.
  std::vector<SearchRun> Measure(int workers, int leaves);

 private:
  void PrepareTask();
  void TellTask();
  SearchQuestion QuestionFor(std::int64_t seed, int workers, int leaves) const;
  SearchRun MeasureOne(std::int64_t seed, int workers, int leaves);
  void FillFromServers(const std::vector<model_info_t>& before, SearchRun* run);
  std::vector<model_info_t> FreshInfos(std::int64_t since_utime);

  Conversation& talk_;
  cli::BenchSearchOptions options_;
  Crew crew_;
  Traffic traffic_;
  SearchSession session_;
  task_t task_{};
  model_info_t model_{};
};

}  // namespace prospect::services

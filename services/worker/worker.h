#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "services/binding/request_window.h"
#include "services/binding/server_list.h"
#include "services/binding/shared_search.h"
#include "services/binding/subtree_counter.h"
#include "services/common/bus.h"
#include "services/common/clock.h"
#include "services/common/health.h"
#include "services/worker/journal.h"

namespace prospect::services {

struct WorkerOptions {
  std::int64_t index =
      -1;  ///< breaks ties differently in each worker; negative: from the random writer id
  int statistics_period_ms = 40;  ///< how often rows are sent while searching
  int statistics_bytes = 8192;    ///< byte budget of one SEARCH_STATISTICS message
  std::string journal;            ///< file for all that is heard and chosen; empty: none
};

/// A planner worker: lends its hands to whatever search SEARCH_ROOT announces, together with all
/// other workers on the bus. It holds one search at a time and stays with it until it is stopped or
/// its root has been silent for a second; it may come late, miss messages, and be killed, and the
/// search goes on. After SEARCH_STOP it sends its final rows until the search's successor begins or
/// half a second has passed.
///
/// One thread: construct, then call Turn() until it is time to stop. The bus must outlive it.
class Worker {
 public:
  Worker(Bus& bus, const WorkerOptions& options);

  /// Waits for messages until the next thing is due, at most 100 ms, then does what is due.
  void Turn();

  /// The last word on HEALTH.
  void Leave();

 private:
  enum class Phase { kIdle, kSearching, kClosing };

  void OnTask(const task_t& task);
  void OnInfo(const model_info_t& info);
  void OnRoot(const search_root_t& root);
  void OnStop(const search_stop_t& stop);
  void OnReply(const expand_reply_t& reply);
  void OnRequest(const expand_request_t& request);
  void OnStatistics(const search_statistics_t& statistics);

  bool Wanted(const search_root_t& root, std::int64_t now_ms) const;
  void Begin(const search_root_t& root, std::int64_t now_ms);
  void Refuse(const search_root_t& root, const char* reason, const char* what);
  void Close(const char* why);
  void Advance();
  void SpreadWork(std::int64_t now_ms);
  void AskForMissing(std::int64_t now_ms);
  void SendRequests(std::int64_t now_ms);
  bool StatisticsDue(std::int64_t now_ms);
  void SendStatistics(std::int64_t now_ms);
  void CheckAbandoned(std::int64_t now_ms);
  void Conclude();
  void Report();
  int TimeoutMs(std::int64_t now_ms) const;

  Bus& bus_;
  WorkerOptions options_;
  HealthBeacon health_;
  ServerList servers_;
  RequestWindow window_;
  std::unique_ptr<Journal> journal_;  // null: none is kept
  SubtreeCounter subtrees_;
  std::set<std::int64_t> ready_servers_;  // that hold the present search
  std::optional<task_t> task_;
  std::unique_ptr<SharedSearch> shared_;
  Phase phase_ = Phase::kIdle;
  Periodic statistics_due_;
  std::set<std::int64_t> stopped_searches_;  // sticky: a search once stopped stays so
  std::int64_t root_heard_ms_ = 0;
  std::int64_t closing_since_ms_ = 0;
  std::int64_t rollouts_before_ = 0;  // of earlier searches
  std::vector<Subscription> subscriptions_;
};

}  // namespace prospect::services

#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "lcmtypes/messages.h"
#include "planner/search.h"
#include "planner/task_rules.h"
#include "services/binding/request_window.h"

namespace prospect::services {

/// A planner::Search fed from the bus: what a worker and an executive both do with what they hear.
/// Messages of other searches and epochs, and evaluations made by other weights, are left alone.
/// Owns the search. One thread; time is an argument.
class SharedSearch {
 public:
  /// @param writer this process's writer id, random per start; @param worker_index breaks ties
  /// differently in each worker Throws std::invalid_argument when rules or parameters are out of
  /// range.
  SharedSearch(const search_root_t& root, const planner::TaskRules& rules, std::int64_t writer,
               int worker_index, std::int64_t now_us, int listed_futures = 16);

  /// Stores the evaluations, whoever asked for them. With `only_awaited` set, and sharing off, only
  /// what that window awaits: tell the window of the reply afterwards.
  void Hear(const expand_reply_t& reply, const RequestWindow* only_awaited = nullptr);
  /// Counts another client's paths as in flight (with sharing only).
  void Hear(const expand_request_t& request, std::int64_t client_id, std::int64_t now_us);
  /// Merges another writer's rows. Observers call it even with sharing off, to see everybody's
  /// work.
  void Hear(const search_statistics_t& statistics, std::int64_t now_us);

  bool Concerns(std::int64_t search_id, std::int32_t epoch) const {
    return search_id == root_.search_id && epoch == root_.epoch;
  }

  planner::Search& search() { return *search_; }
  const planner::Search& search() const { return *search_; }
  const search_root_t& root() const { return root_; }
  bool sharing() const { return root_.sharing != 0; }
  /// Evaluations that the planner would not take (numbers out of range, paths against the rules).
  std::int64_t refused_evaluations() const { return refused_evaluations_; }

 private:
  search_root_t root_;
  std::unique_ptr<planner::Search> search_;
  std::int64_t refused_evaluations_ = 0;
};

/// How long a writer's visits in flight hold without news, milliseconds.
inline constexpr int kLeaseMs = 1000;

/// One line for logs and HEALTH: the names of the plan's actions and its score, or why there is
/// none.
std::string Summary(const planner::Plan& plan, const task_t& task);

}  // namespace prospect::services

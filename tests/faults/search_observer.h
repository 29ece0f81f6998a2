#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "services/binding/shared_search.h"
#include "services/common/bus.h"

namespace prospect::tests {

/// Listens to the latest search on a bus as an executive does, and keeps its history: for tests
/// that ask how a search went on after a fault. Merges rows with the planner's own library. Belongs
/// to the bus's thread; the bus must outlive it.
class SearchObserver {
 public:
  explicit SearchObserver(services::Bus& bus);

  /// Rollouts of all writers of the latest search, as known now; 0 before the first root.
  std::int64_t rollouts() const;
  /// Rollouts a second of all writers between two moments (services::SteadyMs), by when they became
  /// known.
  double RolloutRate(std::int64_t from_ms, std::int64_t to_ms) const;

  /// What is known of a writer; nothing when it was never heard.
  std::optional<planner::WriterView> View(std::int64_t writer) const;
  /// Visits in flight at the root, over live writers.
  std::int64_t in_flight() const;

  /// The most rollouts of `writer` that `relay` has told of in its own messages.
  std::int64_t Relayed(std::int64_t relay, std::int64_t writer) const;

  /// Distinct paths evaluated, by whoever.
  std::size_t evaluated() const { return evaluated_.size(); }
  /// When the first evaluation by this server came, SteadyMs; 0: never.
  std::int64_t FirstReplyMs(std::int64_t server) const;
  /// Longest time without a rollout completed by `writer`, from `since_ms` to `to_ms`,
  /// milliseconds.
  std::int64_t LongestStallMs(std::int64_t writer, std::int64_t since_ms, std::int64_t to_ms) const;

 private:
  struct Moment {
    std::int64_t at_ms;
    std::int64_t rollouts;
  };
  using Timeline = std::vector<Moment>;

  void OnRoot(const search_root_t& root);
  void OnStatistics(const search_statistics_t& statistics);
  void OnReply(const expand_reply_t& reply);
  static void Note(std::int64_t rollouts, Timeline* timeline);
  static std::int64_t At(const Timeline& timeline, std::int64_t at_ms);

  std::optional<task_t> task_;
  std::unique_ptr<services::SharedSearch> search_;
  Timeline all_;
  std::map<std::int64_t, Timeline> by_writer_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> relayed_;
  std::set<planner::Path> evaluated_;
  std::map<std::int64_t, std::int64_t> first_reply_ms_;
  std::vector<services::Subscription> subscriptions_;
};

}  // namespace prospect::tests

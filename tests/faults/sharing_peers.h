#pragma once

#include <array>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "planner/path_tree.h"
#include "planner/shared_statistics.h"
#include "services/common/bus.h"

namespace prospect::tests {

/// What every writer's rows really were: the value sum and best value at each count of visits. Rows
/// that anybody holds must be among them.
class Truth {
 public:
  void Note(std::uint64_t writer, const planner::StatisticsRow& row);
  bool Knows(const planner::StatisticsRow& row) const;

 private:
  using Key = std::tuple<std::uint64_t, planner::Path, std::int64_t>;  // writer, path, visits
  std::map<Key, std::pair<std::int64_t, float>> rows_;
};

/// A writer of statistics as a worker is one, without the search: makes rollouts along random paths
/// and shares their rows over LCM, through the real codec and message layout. One thread.
class Peer {
 public:
  /// @param chaos what this peer's ears suffer
  Peer(std::uint64_t writer, const std::string& chaos, Truth* truth);

  /// Opens its bus anew with other faults: what was still underway is lost.
  void SetChaos(const std::string& chaos);

  void MakeRollout();
  /// Completes what is in flight; no rollout after it.
  void Finish();
  void SayRows();
  void Hear(int wait_ms) { bus_->Poll(wait_ms); }

  const planner::SharedStatistics& statistics() const { return statistics_; }
  const services::Bus& bus() const { return *bus_; }

 private:
  using Branch = std::vector<planner::PathId>;  // root to leaf
  Branch RandomBranch();
  void Complete(const Branch& branch);

  Truth* truth_;
  std::mt19937_64 random_;
  planner::PathTree paths_;
  planner::SharedStatistics statistics_;
  std::vector<Branch> in_flight_;
  std::unique_ptr<services::Bus> bus_;
  services::Subscription subscription_;
};

/// Four peers on one bus, and what must always hold among them.
class Peers {
 public:
  /// `chaos` lacks a seed: each peer gets its own.
  explicit Peers(const std::string& chaos);

  /// `ticks` ticks of a few milliseconds in which each makes `rollouts` rollouts, tells and hears.
  /// Checks exactness throughout.
  void Work(int ticks, int rollouts);
  void Finish();
  void SetChaos(const std::string& chaos);

  /// Tells and hears without new rollouts until all agree. @return the most times that any peer's
  /// round-robin went over all of its rows meanwhile, or -1 if they did not agree in 10 s
  int RoundsUntilAgreed();

  /// Fails the test unless every row held is one that its writer had, and every writer's count is
  /// exact wherever digests agree.
  void CheckExact();

  bool Agreed() const;
  /// How often CheckExact saw the digest of another writer agree.
  std::int64_t agreements() const { return agreements_; }
  std::vector<std::unique_ptr<Peer>> peers;

 private:
  void Exchange();
  void CheckView(const planner::WriterView& view, const std::vector<planner::StatisticsRow>& rows);

  Truth truth_;
  std::int64_t agreements_ = 0;
};

}  // namespace prospect::tests

// One worker's part of a search: Algorithm 1 of the paper, cut into pieces that never wait. The
// owner passes in what is heard (evaluations, other workers' statistics and requests) and the time,
// and sends out what Advance and MakeBatch give. The same class, never told to Advance, is how an
// observer reads off the plan.
//
//   EVALUATE  V and f of the node; f < c_done makes the value 0; neither is tested at the root.
//   SAMPLE    The selection rule's best child among those the task allows and p permits.
//   T         Asked for: Advance returns the path, Deliver brings its evaluation, and the rollout
//             walks on.
//   UPDATE    N, W, v* of every node on the path; the rule says how the value is formed (Backup).
//
// A rollout ends at depth d, at a value below v_failed, at a failed action (value 0), where the
// plan is complete (value V), or where nothing more is permitted (value 0). N counts rollouts;
// evaluations are another count: a rollout over known paths needs none, one into unknown country
// needs one for each step.
//
// Not thread safe; no threads, clock or randomness inside. Given the same calls in the same order,
// it does the same.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "planner/child_lists.h"
#include "planner/evaluation_table.h"
#include "planner/foreign_rollouts.h"
#include "planner/plan.h"
#include "planner/rollout_claims.h"
#include "planner/search_parameters.h"
#include "planner/selection_rule.h"
#include "planner/shared_statistics.h"
#include "planner/task_rules.h"

namespace prospect::planner {

// Why no rollout is started any more.
enum class StopReason {
  kRunning,
  kSamples,
  kExhausted,
  kDeadline,
  kStopped,
};
const char* ToString(StopReason reason);

// Who searches what.
struct SearchIdentity {
  SearchId search;
  std::uint64_t writer = 1;           // random per process start, never 0
  int worker_index = 0;               // breaks ties differently in each worker
  std::int64_t lease_us = 1'000'000;  // SharedStatisticsOptions::lease_us
};

enum class Delivery {
  kNew,
  kReplaced,  // a lower (fingerprint, V) took the place of a known one
  kDuplicate,
  kRefused,  // not num_actions numbers, not in [0, 1], or a path that the task's rules exclude
};

class Search {
 public:
  // `executed`: actions already carried out before this root. Throws std::invalid_argument for bad
  // rules or parameters.
  Search(TaskRules rules, SearchParameters parameters, Path executed, SearchIdentity identity);
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  // --- what is heard
  // An evaluation, whoever asked for it. `fingerprint`: the engine's. The rollouts that waited for
  // it move at the next Advance.
  Delivery Deliver(const Path& path, const Evaluation& evaluation, std::uint64_t fingerprint);
  // Another worker asked for these paths: this worker does not ask too, for patience_us. Its
  // rollouts count as in flight along their whole paths until its rows hold them, if `writer` tells
  // whose they are (0: unknown; then only the path itself counts, until its evaluation comes).
  void NoteRequested(const std::vector<Path>& paths, std::int64_t now_us, std::uint64_t writer = 0);
  // Other workers' rows; see SharedStatistics::Merge. Workers that search apart (a search that was
  // never told to Advance only watches, and takes all) take none; the same goes for NoteRequested.
  int Merge(const StatisticsBatch& batch, std::int64_t now_us);

  // --- what is to be sent
  // Lets every rollout in flight go as far as evaluations allow, then starts new ones until
  // `max_new_leaves` more paths (plus one for each rollout that just ended) are to be evaluated
  // that nobody has asked for, or done(). Returns all paths to be asked for, each once (until
  // Abandon). Call it with max(0, wanted - waiting()) to keep `wanted` rollouts in flight: whenever
  // something was delivered or merged, and every 50 ms or so, because a path that another worker
  // asked for is asked for here only after patience_us.
  std::vector<Path> Advance(int max_new_leaves, std::int64_t now_us);
  // See SharedStatistics::MakeBatch; fills in this worker's totals and renews its claim
  // (planner/rollout_claims.h). From the first call on, rollouts begin only as far as claims go:
  // call it every 20 to 50 ms, and before the first Advance where others may be at work, so that
  // they know of each other.
  StatisticsBatch MakeBatch(std::size_t byte_budget, std::int64_t now_us);
  // This worker had used up its claim and has just renewed it, still waits for others' claims and
  // has not said its own for some milliseconds, or is finished and nobody knows: others may be
  // waiting, too. Send MakeBatch now and not at the next tick.
  bool WantsExchange() const { return hurried_; }
  // Visited paths whose evaluation was never heard here, at most `limit`: ask for them before
  // BestPlan, or it may differ from other processes' plans.
  std::vector<Path> MissingEvaluations(int limit) const;

  // --- ending
  // This evaluation will not come: rollouts that wait for it are given up, and it may be asked for
  // again.
  void Abandon(const Path& path);
  // Gives up all rollouts in flight and starts no more. Rows and evaluations are still taken in.
  void Stop();
  // No rollout will be started: N + O at the root (all writers, or this worker's part of the
  // samples where workers search apart) reached the samples, every permitted future is known and
  // visited, the deadline has passed, or Stop. kSamples may turn back to kRunning when a silent
  // writer's lease ends. Whatever the reason, BestPlan is the best that is known so far, at any
  // time.
  StopReason stop_reason(std::int64_t now_us) const;
  bool done(std::int64_t now_us) const { return stop_reason(now_us) != StopReason::kRunning; }
  // done, and nothing of this worker's is in flight: its counts are final.
  bool finished(std::int64_t now_us) const { return done(now_us) && rollouts_.empty(); }

  // --- the answer, and counts
  Plan BestPlan() const;
  int waiting() const { return static_cast<int>(rollouts_.size()); }  // own rollouts in flight
  std::int64_t rollouts() const;                                      // completed by this worker
  std::int64_t total_rollouts() const;                           // completed by all, as known here
  std::int64_t evaluations() const { return own_evaluations_; }  // asked for here, and answered
  std::int64_t known_evaluations() const { return evaluations_.size(); }  // heard, whoever asked
  SharedStatistics& statistics() { return statistics_; }
  const SharedStatistics& statistics() const { return statistics_; }
  const PathTree& paths() const { return paths_; }
  const EvaluationTable& evaluation_table() const { return evaluations_; }
  const TaskRules& rules() const { return rules_; }
  const SearchParameters& parameters() const { return parameters_; }
  const Path& executed() const { return executed_; }

 private:
  enum class Pending : std::uint8_t { kNo, kOwn, kForeign };

  struct Node {
    std::int64_t pending_since_us = 0;
    double open = 0;                  // ChildView::open; kept where the rule asks for it
    std::int32_t first_allowed = -1;  // into allowed_, once known
    std::uint8_t num_allowed = 0;
    Pending pending = Pending::kNo;
    bool complete = false;   // by the task's rules; known with first_allowed
    bool exhausted = false;  // everything below is known and visited
  };

  // How far a rollout came: its leaf has no evaluation, or it ended.
  enum class Walked { kEnded, kBlocked };

  // One rollout: search_rollout.cpp.
  Node& NodeOf(PathId id);
  void ResolveRules(PathId id);
  bool EndsHere(PathId id, double* value);
  bool Permitted(PathId id, int action) const;
  void ListChildren(PathId id);
  PathId SelectChild(PathId id, std::int64_t* before);
  ParentView ViewOf(PathId id, const ChildLists::List& list) const;
  void ViewChildren(PathId id, ChildEntry* entries, int count);
  int Best(const ParentView& parent, const ChildEntry* entries, int count);
  std::int64_t InFlightOfOthers(PathId id) const;
  std::int64_t AskedElsewhere(PathId id) const;
  std::int64_t VisitedElsewhere(PathId id, const PathTotals& totals) const;
  Walked Walk(std::int64_t before, PathId* at, double* value);
  void BackUp(PathId leaf, double value);
  void GiveUp(PathId leaf);
  void Absorb();
  void UpdateExhausted(PathId id);
  bool Exhausted(PathId id) const;
  bool NowExhausted(PathId id);

  // What is open: search_open.cpp.
  double Reach(PathId id) const;
  double OpenChild(double reach, const ChildEntry& entry) const;
  double OpenBelow(PathId id);
  void UpdateOpen(PathId id);

  // Many rollouts: search.cpp.
  int ResumeRollouts(std::int64_t now_us, std::vector<Path>* requests);
  void StartRollouts(int max_new_leaves, std::int64_t now_us, std::vector<Path>* requests);
  std::int64_t OthersBefore() const;
  void NoteEnded(PathId id, std::uint64_t writer);
  void NoteBegun(std::uint64_t writer);
  void OneStays(std::uint64_t writer, PathId id);
  void LeaveTo(PathId id);
  bool Request(PathId id, std::int64_t now_us, std::vector<Path>* requests);
  void SetPending(PathId id, Pending pending, std::int64_t now_us);
  bool MayStart(std::int64_t now_us);
  bool MayClaim(std::int64_t now_us);
  bool Apart() const;
  std::int64_t OwnBegun() const;
  std::int64_t Budget() const;

  TaskRules rules_;
  SearchParameters parameters_;
  Path executed_;
  SearchIdentity identity_;
  int depth_;  // longest path of this search
  std::unique_ptr<const SelectionRule> rule_;
  PathTree paths_;
  EvaluationTable evaluations_;
  SharedStatistics statistics_;
  RolloutClaims claims_;
  ChildLists children_;
  ForeignRollouts foreign_;
  std::vector<std::uint64_t> freed_;   // writers whose rollouts ended since the last Advance
  std::vector<Node> nodes_;            // by path id
  std::vector<std::uint8_t> allowed_;  // allowed actions of all nodes, one after the other
  std::vector<PathId> rollouts_;       // own rollouts in flight: the path each waits for
  std::vector<PathId> given_up_;       // scratch of StartRollouts
  std::vector<ChildView> views_;       // scratch of SelectChild
  std::vector<double> scores_;         // scratch of SelectChild
  std::vector<std::int64_t> taken_;    // scratch of SelectChild
  std::int64_t own_evaluations_ = 0;
  bool advanced_ = false;  // a worker, not an observer
  bool hurried_ = false;
  std::int64_t announced_us_ = 0;  // when the last batch was made
  bool announced_finished_ = false;
  bool stopped_ = false;
};

}  // namespace prospect::planner

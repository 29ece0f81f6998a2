// The visit statistics of a search, shared among any number of writers (planner workers) over a
// transport that may lose, repeat and reorder messages. Rows are keyed by (writer, path). Merging
// keeps, for each key, the greatest row in the order (N, version, heard from the writer itself
// before relayed, W, v*); because that is a maximum, any set of batches merged in any order and any
// number of times gives one table (a join semilattice: Shapiro et al. 2011, state-based CRDTs).
// N, W and live O are summed over writers; v* is their maximum.
//
// Visits in flight are the one thing that is not permanent. A writer's O counts only while a batch
// of its own with a higher sequence number than before was heard within the lease, on the
// receiver's own steady clock; relays and duplicates do not renew it, so a killed worker stops
// repelling the others after one lease.
//
// Between two rows of a path others' visits are known of from elsewhere: Announce. A row covers
// what was announced of its writer before it, so that every visit counts once.
//
// Not thread safe. Refers to a PathTree that must outlive it. Time is an argument, in microseconds
// of any steady clock. Rows that break the rules of planner/statistics_batch.h are refused and
// counted, never thrown at the caller.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "planner/path_tree.h"
#include "planner/row_index.h"
#include "planner/statistics_batch.h"

namespace prospect::planner {

struct SharedStatisticsOptions {
  SearchId search;
  std::uint64_t writer = 0;           // this process; random per start, never 0
  std::int64_t lease_us = 1'000'000;  // > 0
  int max_writers = 2048;             // rows of writers beyond this many known ones are refused
  int max_paths = 4'000'000;          // rows for paths beyond this many known ones are refused
  // While the writer is at work, batches take no more than this many bytes for each of its rollouts
  // (but always room for a few rows); closing batches, and a round after a new writer was heard
  // or heard of, may fill the whole budget. 0: no such limit.
  std::size_t bytes_per_rollout = 0;
};

// Sums over writers for one path.
struct PathTotals {
  std::int64_t visits = 0;     // N
  std::int64_t value_sum = 0;  // W, in units of 1 / kValueOne
  std::int64_t in_flight = 0;  // live O
  float best = 0;              // v*
  std::int32_t announced = 0;  // others' visits that are in no row yet: Announce
  double mean() const {
    return visits > 0 ? static_cast<double>(value_sum) / kValueOne / visits : 0;
  }
};

// What was refused, by reason. The first two refuse a whole batch, the others one row.
struct RefusalCounts {
  std::int64_t other_search = 0;     // another search id or epoch
  std::int64_t checksum = 0;         // payload and checksum disagree, or no writer
  std::int64_t visits_fell = 0;      // N falls while the version grows (or the reverse)
  std::int64_t best_range = 0;       // v* outside [0, 1] or NaN
  std::int64_t in_flight_range = 0;  // O < 0
  std::int64_t sum_range = 0;        // N < 0, or W outside [0, N kValueOne]
  std::int64_t path = 0;             // action outside the table, path too long, table full
  std::int64_t writers = 0;          // more writers than max_writers: whole batches and rows
  std::int64_t own_row = 0;          // a row under this writer's id that this writer did not make
  std::int64_t total() const;
};

// What is known of one writer.
struct WriterView {
  std::uint64_t id = 0;
  bool live = false;          // within its lease (this process: always)
  bool heard = false;         // a batch of its own was heard (not only relays)
  WriterTotals announced;     // from its newest batch; this process: its current totals
  std::int64_t rows = 0;      // rows with N > 0 known here
  std::uint64_t digest = 0;   // of these rows
  std::int64_t rollouts = 0;  // of which N at the root
  bool Converged() const { return heard && rows == announced.rows && digest == announced.digest; }
};

class SharedStatistics {
 public:
  // Throws std::invalid_argument for a writer of 0 or a lease that is not positive.
  SharedStatistics(PathTree* paths, const SharedStatisticsOptions& options);

  // --- this writer's own rows; O(1), no allocation beyond growth. `id` must be in the PathTree.
  void Begin(PathId id);                   // O += 1: a rollout goes through
  void Cancel(PathId id);                  // O -= 1: it was given up
  void Complete(PathId id, double value);  // O -= 1, N += 1, W += value, v* = max; value in [0, 1]

  // --- sums over all writers. Unknown ids have all zeros.
  const PathTotals& totals(PathId id) const;
  std::int64_t own_in_flight(PathId id) const;  // this writer's part of O
  std::int64_t own_visits(PathId id) const;     // and of N

  // Another writer's visits to the nodes from `leaf` up to, but not at, `above` (kNoPath: up to the
  // root), begun (+1) or given up (-1), heard of not by a row. They count as announced until a row
  // of that writer's own comes for the node, or its lease ends; a relayed row takes off them what
  // it adds. False, and nothing happens, for this writer itself and for writers beyond max_writers.
  bool Announce(std::uint64_t writer, PathId leaf, PathId above, int sign);

  // --- exchange
  // Takes over what is newer, and tells live from silent writers at time `now_us`. Returns how many
  // rows changed.
  int Merge(const StatisticsBatch& batch, std::int64_t now_us);
  // This process's next batch within `byte_budget` (counted by RowBytes) and bytes_per_rollout. Own
  // rows that changed since they were last sent are chosen first, the greatest unsent N first (a
  // parent before its child); a quarter of the budget is kept for the round-robin over all rows
  // known, those of other writers as relays with O = 0. At least one row of each kind is sent if
  // there is one, however small the budget. Rows stand sorted by (writer, path), the sender's
  // first.
  StatisticsBatch MakeBatch(std::size_t byte_budget, std::int64_t now_us);
  // Stops counting the O of writers whose lease has run out at `now_us`. Merge and MakeBatch do so
  // too.
  void ExpireLeases(std::int64_t now_us);

  // What the search adds to this writer's announced totals.
  void SetOwnEvaluations(std::int64_t evaluations) { own_evaluations_ = evaluations; }
  void SetFinished(bool finished) { finished_ = finished; }
  void SetClaim(std::int64_t claimed, std::int64_t round) { claimed_ = claimed, round_ = round; }

  // Paths whose N rose from 0 since the last call, in that order.
  std::vector<PathId> TakeNewlyVisited();

  // --- inspection
  WriterTotals own_totals() const;  // what the next batch will announce
  // Digest of all rows with N > 0 of all writers; equal tables have equal digests whatever the
  // order of arrival.
  std::uint64_t digest() const;
  std::int64_t rows() const;                          // rows with N > 0, over all writers
  std::vector<WriterView> writers() const;            // this process first, the others by id
  std::vector<WriterView> others() const;             // without this process, in no order
  int live_writers() const { return live_writers_; }  // within their leases, this process included
  bool ConvergedWithLive() const;  // every live writer's announced rows are all known here
  std::int64_t round_robin_rounds() const {
    return rounds_;
  }  // times the round-robin went over all rows
  std::vector<StatisticsRow> AllRows()
      const;  // rows with N > 0 sorted by (path, writer), O as known: for tests and logs
  const RefusalCounts& refusals() const { return refusals_; }
  const SearchId& search() const { return options_.search; }
  std::uint64_t writer() const { return options_.writer; }

 private:
  struct Row {
    std::uint64_t version = 0;
    std::int64_t visits = 0;
    std::int64_t value_sum = 0;
    std::uint64_t digest = 0;  // RowDigest of the above
    float best = 0;
    std::int32_t in_flight = 0;
    std::int32_t announced = 0;  // since this row came
    bool direct = false;         // heard from the writer itself
    bool known = false;          // listed in known_
  };
  struct Sent {
    std::int64_t visits = 0;
    std::int32_t in_flight = 0;
    bool dirty = false;          // listed in dirty_
    std::uint64_t in_batch = 0;  // sequence of the last batch that carried it
  };
  struct Writer {
    std::uint64_t id = 0;
    std::uint64_t sequence = 0;  // highest heard
    std::int64_t heard_us = 0;
    bool live = false;
    WriterTotals announced;
    std::vector<PathId> paths;  // of its rows; not this process's
    std::int64_t count = 0;
    std::uint64_t digest = 0;
  };
  struct RowKey {
    int writer;
    PathId path;
  };

  Row& OwnRow(PathId id);
  Row& RowOf(int writer, PathId id);
  const Row* FindRow(int writer, PathId id) const;
  PathTotals& TotalsOf(PathId id);
  bool RoomFor(std::uint64_t writer);
  int WriterIndex(std::uint64_t id);
  std::uint64_t RowDigest(const Row& row, PathId id) const;
  void Touch(PathId id, Row* row);
  void NoteKnown(int writer, PathId id, Row* row);
  void NoteFirstVisit(PathId id, std::int64_t visits_before);
  bool AcceptBatch(const StatisticsBatch& batch);
  void NoteHeard(const StatisticsBatch& batch, std::int64_t now_us);
  bool Sound(const StatisticsRow& row);
  static std::int32_t NotCovered(const Row& before, const Row& row, bool live);
  bool MergeRow(const StatisticsRow& row, int writer, bool direct);
  bool ReplaceRow(int writer, PathId id, const Row& fresh);
  float BestOverWriters(PathId id) const;
  void SetLive(int writer, bool live);
  WriterView ViewOf(int writer) const;
  void TellAll();
  std::size_t Allowance(std::size_t byte_budget);
  std::vector<PathId> ChangedRows(std::size_t most);
  std::size_t AddChanged(std::size_t byte_budget, StatisticsBatch* batch);
  std::size_t AddRoundRobin(std::size_t byte_budget, StatisticsBatch* batch);
  StatisticsRow Export(int writer, PathId id) const;

  PathTree* paths_;
  SharedStatisticsOptions options_;
  std::vector<Writer> writers_;  // index 0: this process
  std::unordered_map<std::uint64_t, int> writer_index_;
  std::vector<PathTotals> totals_;  // by path id
  std::vector<Row> own_rows_;       // by path id
  // Rows of others, found by (writer index, path id): a thousand writers each know few paths.
  std::vector<Row> other_rows_;
  RowIndex other_index_;
  std::vector<Sent> sent_;  // by path id, own rows
  std::vector<PathId> dirty_;
  std::vector<RowKey> known_;  // every row ever known, in order of appearance
  std::size_t cursor_ = 0;     // of the round-robin, into known_
  std::int64_t rounds_ = 0;
  std::int64_t full_until_round_ = 0;  // a new writer is known: no steady limit before that round
  std::size_t allowance_ = 0;          // bytes not yet used of bytes_per_rollout
  std::int64_t allowed_rollouts_ = 0;  // rollouts that it was granted for
  std::vector<PathId> newly_visited_;
  int live_writers_ = 1;
  std::uint64_t sequence_ = 0;  // batches made
  std::int64_t own_evaluations_ = 0;
  std::int64_t claimed_ = 0;
  std::int64_t round_ = 0;
  bool finished_ = false;
  RefusalCounts refusals_;
};

}  // namespace prospect::planner

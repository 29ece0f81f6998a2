#include "planner/shared_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <tuple>

namespace prospect::planner {
namespace {

constexpr int kOwn = 0;  // this process, in writers_

std::uint64_t Bits(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

// The order whose maximum Merge keeps. N comes first: it only grows, so that for an honest writer
// this is the order of versions, and for any other the result still does not depend on the order of
// arrival.
template <typename RowLike>
auto MergeKey(const RowLike& row, bool direct) {
  return std::make_tuple(row.visits, row.version, direct, row.value_sum, Bits(row.best));
}

bool InUnit(float x) { return x >= 0.0f && x <= 1.0f; }

bool SumInRange(const StatisticsRow& row) {
  // In double: N kValueOne may not fit 64 bits if a peer sends nonsense.
  return row.visits >= 0 && row.value_sum >= 0 &&
         static_cast<double>(row.value_sum) <=
             static_cast<double>(row.visits) * static_cast<double>(kValueOne);
}

}  // namespace

std::int64_t RefusalCounts::total() const {
  return other_search + checksum + visits_fell + best_range + in_flight_range + sum_range + path +
         writers + own_row;
}

SharedStatistics::SharedStatistics(PathTree* paths, const SharedStatisticsOptions& options)
    : paths_(paths), options_(options) {
  if (options.writer == 0) throw std::invalid_argument("a writer's id must not be 0");
  if (options.lease_us <= 0) throw std::invalid_argument("the lease must be above 0 us");
  Writer& own = writers_.emplace_back();
  own.id = options.writer;
  own.live = true;
  writer_index_[own.id] = kOwn;
}

// --- this writer's own rows

void SharedStatistics::Begin(PathId id) {
  Row& row = RowOf(kOwn, id);
  ++row.in_flight;
  ++TotalsOf(id).in_flight;
  Touch(id, &row);
}

void SharedStatistics::Cancel(PathId id) {
  Row& row = RowOf(kOwn, id);
  --row.in_flight;
  --TotalsOf(id).in_flight;
  Touch(id, &row);
}

void SharedStatistics::Complete(PathId id, double value) {
  Row& row = RowOf(kOwn, id);
  const Row before = row;
  const auto sum = static_cast<std::int64_t>(std::llround(value * static_cast<double>(kValueOne)));
  --row.in_flight;
  ++row.visits;
  row.value_sum += sum;
  row.best = std::max(row.best, static_cast<float>(value));

  PathTotals& totals = TotalsOf(id);
  NoteFirstVisit(id, totals.visits);
  --totals.in_flight;
  ++totals.visits;
  totals.value_sum += sum;
  totals.best = std::max(totals.best, row.best);
  ReplaceDigest(&writers_[kOwn], id, before, row);
  Touch(id, &row);
}

void SharedStatistics::Touch(PathId id, Row* row) {
  row->version = ++clock_;
  row->direct = true;
  NoteKnown(kOwn, id, row);
  if (id >= static_cast<int>(sent_.size())) sent_.resize(paths_->size());
  if (sent_[id].dirty) return;
  sent_[id].dirty = true;
  dirty_.push_back(id);
}

// --- sums

const PathTotals& SharedStatistics::totals(PathId id) const {
  static const PathTotals kNothing;
  return id >= 0 && id < static_cast<int>(totals_.size()) ? totals_[id] : kNothing;
}

std::int64_t SharedStatistics::own_in_flight(PathId id) const {
  const std::vector<Row>& rows = writers_[kOwn].rows;
  return id < static_cast<int>(rows.size()) ? rows[id].in_flight : 0;
}

SharedStatistics::Row& SharedStatistics::RowOf(int writer, PathId id) {
  std::vector<Row>& rows = writers_[writer].rows;
  if (id >= static_cast<int>(rows.size())) rows.resize(paths_->size());
  return rows[id];
}

PathTotals& SharedStatistics::TotalsOf(PathId id) {
  if (id >= static_cast<int>(totals_.size())) totals_.resize(paths_->size());
  return totals_[id];
}

void SharedStatistics::NoteFirstVisit(PathId id, std::int64_t visits_before) {
  if (visits_before == 0) newly_visited_.push_back(id);
}

std::vector<PathId> SharedStatistics::TakeNewlyVisited() {
  std::vector<PathId> taken;
  taken.swap(newly_visited_);
  return taken;
}

void SharedStatistics::NoteKnown(int writer, PathId id, Row* row) {
  if (row->known) return;
  row->known = true;
  known_.push_back({writer, id});
}

// --- digests: sums of one number a row, so that the order of arrival cannot matter

std::uint64_t SharedStatistics::RowDigest(const Row& row, PathId id) const {
  if (row.visits == 0) return 0;
  std::uint64_t digest = HashCombine(paths_->hash(id), static_cast<std::uint64_t>(row.visits));
  digest = HashCombine(digest, static_cast<std::uint64_t>(row.value_sum));
  return HashCombine(digest, Bits(row.best));
}

void SharedStatistics::ReplaceDigest(Writer* writer, PathId id, const Row& before,
                                     const Row& after) {
  writer->digest += RowDigest(after, id) - RowDigest(before, id);
  writer->count += (after.visits > 0 ? 1 : 0) - (before.visits > 0 ? 1 : 0);
}

std::uint64_t SharedStatistics::digest() const {
  std::uint64_t sum = 0;
  for (const Writer& writer : writers_) {
    if (writer.count > 0) sum += HashCombine(writer.id, writer.digest);
  }
  return sum;
}

std::int64_t SharedStatistics::rows() const {
  std::int64_t count = 0;
  for (const Writer& writer : writers_) count += writer.count;
  return count;
}

// --- merging

int SharedStatistics::Merge(const StatisticsBatch& batch, std::int64_t now_us) {
  ExpireLeases(now_us);
  if (!AcceptBatch(batch)) return 0;
  NoteHeard(batch, now_us);
  int changed = 0;
  for (const StatisticsRow& row : batch.rows) {
    if (Sound(row) && MergeRow(row, row.writer == batch.writer)) ++changed;
  }
  return changed;
}

bool SharedStatistics::AcceptBatch(const StatisticsBatch& batch) {
  if (batch.search != options_.search) {
    ++refusals_.other_search;
    return false;
  }
  if (batch.writer == 0 || batch.checksum != PayloadChecksum(batch)) {
    ++refusals_.checksum;
    return false;
  }
  if (!RoomFor(batch.writer)) return false;
  return batch.writer != options_.writer;  // a bus also brings back what one sent oneself
}

void SharedStatistics::NoteHeard(const StatisticsBatch& batch, std::int64_t now_us) {
  Writer& writer = writers_[WriterIndex(batch.writer)];
  if (batch.sequence <= writer.sequence) return;
  writer.sequence = batch.sequence;
  writer.heard_us = now_us;
  writer.announced = batch.totals;
  SetLive(&writer, true);
}

bool SharedStatistics::Sound(const StatisticsRow& row) {
  std::int64_t* reason = nullptr;
  if (!InUnit(row.best)) reason = &refusals_.best_range;
  if (row.in_flight < 0) reason = &refusals_.in_flight_range;
  if (!SumInRange(row)) reason = &refusals_.sum_range;
  if (!paths_->Valid(row.path) || row.writer == 0) reason = &refusals_.path;
  if (reason == nullptr && paths_->size() >= options_.max_paths &&
      paths_->Find(row.path) == kNoPath) {
    reason = &refusals_.path;
  }
  if (reason != nullptr) ++*reason;
  return reason == nullptr && RoomFor(row.writer);
}

bool SharedStatistics::RoomFor(std::uint64_t writer) {
  const bool room =
      static_cast<int>(writers_.size()) < options_.max_writers || writer_index_.count(writer) > 0;
  if (!room) ++refusals_.writers;
  return room;
}

bool SharedStatistics::MergeRow(const StatisticsRow& row, bool direct) {
  const PathId id = paths_->Add(row.path);
  const int writer = WriterIndex(row.writer);
  const Row& known = RowOf(writer, id);
  if (writer == kOwn) {
    if (row.version > known.version || row.visits > known.visits) ++refusals_.own_row;
    return false;
  }
  const bool newer = row.version > known.version;
  if ((newer && row.visits < known.visits) ||
      (row.version < known.version && row.visits > known.visits)) {
    ++refusals_.visits_fell;
  }
  if (MergeKey(row, direct) <= MergeKey(known, known.direct)) return false;
  Row fresh;
  fresh.version = row.version;
  fresh.visits = row.visits;
  fresh.value_sum = row.value_sum;
  fresh.best = row.best;
  fresh.in_flight = direct ? row.in_flight : 0;
  fresh.direct = direct;
  ReplaceRow(writer, id, fresh);
  return true;
}

void SharedStatistics::ReplaceRow(int writer, PathId id, const Row& fresh) {
  Row& row = RowOf(writer, id);
  const Row before = row;
  row = fresh;
  row.known = before.known;
  NoteKnown(writer, id, &row);
  ReplaceDigest(&writers_[writer], id, before, row);

  PathTotals& totals = TotalsOf(id);
  if (row.visits > 0) NoteFirstVisit(id, totals.visits);
  totals.visits += row.visits - before.visits;
  totals.value_sum += row.value_sum - before.value_sum;
  if (writers_[writer].live) totals.in_flight += row.in_flight - before.in_flight;
  totals.best = 0;
  for (const Writer& one : writers_) {
    if (id < static_cast<int>(one.rows.size()))
      totals.best = std::max(totals.best, one.rows[id].best);
  }
}

int SharedStatistics::WriterIndex(std::uint64_t id) {
  const auto found = writer_index_.find(id);
  if (found != writer_index_.end()) return found->second;
  const int index = static_cast<int>(writers_.size());
  writers_.emplace_back().id = id;
  writer_index_[id] = index;
  return index;
}

// --- leases

void SharedStatistics::ExpireLeases(std::int64_t now_us) {
  for (std::size_t i = kOwn + 1; i < writers_.size(); ++i) {
    Writer& writer = writers_[i];
    if (writer.live && now_us - writer.heard_us > options_.lease_us) SetLive(&writer, false);
  }
}

void SharedStatistics::SetLive(Writer* writer, bool live) {
  if (writer->live == live) return;
  writer->live = live;
  const int sign = live ? 1 : -1;
  live_writers_ += sign;
  for (std::size_t id = 0; id < writer->rows.size(); ++id) {
    const std::int32_t in_flight = writer->rows[id].in_flight;
    if (in_flight != 0) TotalsOf(static_cast<PathId>(id)).in_flight += sign * in_flight;
  }
}

// --- sending

StatisticsBatch SharedStatistics::MakeBatch(std::size_t byte_budget, std::int64_t now_us) {
  ExpireLeases(now_us);
  StatisticsBatch batch;
  batch.search = options_.search;
  batch.writer = options_.writer;
  batch.sequence = ++sequence_;
  batch.totals = own_totals();
  const std::size_t for_rows =
      byte_budget > kBatchHeaderBytes ? byte_budget - kBatchHeaderBytes : 0;
  const std::size_t for_round_robin = for_rows / 4;
  AddChanged(for_rows - for_round_robin, &batch);
  AddRoundRobin(for_round_robin, &batch);
  batch.checksum = PayloadChecksum(batch);
  return batch;
}

// Rows whose content differs from what was last sent, most important first, a few more than fit.
std::vector<PathId> SharedStatistics::ChangedRows(std::size_t byte_budget) {
  const std::vector<Row>& rows = writers_[kOwn].rows;
  const auto unsent = [&](PathId id) { return rows[id].visits - sent_[id].visits; };
  const auto same = [&](PathId id) {
    return unsent(id) == 0 && rows[id].in_flight == sent_[id].in_flight;
  };
  const auto first_same =
      std::stable_partition(dirty_.begin(), dirty_.end(), [&](PathId id) { return !same(id); });
  for (auto it = first_same; it != dirty_.end(); ++it) sent_[*it].dirty = false;
  dirty_.erase(first_same, dirty_.end());

  std::vector<PathId> chosen(std::min(dirty_.size(), byte_budget / RowBytes(0) + 1));
  // A child's unsent N is never above its parent's, and its id is higher: parents come first.
  std::partial_sort_copy(dirty_.begin(), dirty_.end(), chosen.begin(), chosen.end(),
                         [&](PathId a, PathId b) {
                           return std::make_pair(-unsent(a), a) < std::make_pair(-unsent(b), b);
                         });
  return chosen;
}

void SharedStatistics::AddChanged(std::size_t byte_budget, StatisticsBatch* batch) {
  std::size_t used = 0;
  for (const PathId id : ChangedRows(byte_budget)) {
    used += RowBytes(paths_->depth(id));
    if (used > byte_budget && !batch->rows.empty()) break;
    batch->rows.push_back(Export(kOwn, id));
    const Row& row = writers_[kOwn].rows[id];
    sent_[id].visits = row.visits;
    sent_[id].in_flight = row.in_flight;
    sent_[id].in_batch = batch->sequence;
  }
}

void SharedStatistics::AddRoundRobin(std::size_t byte_budget, StatisticsBatch* batch) {
  std::size_t used = 0;
  bool added = false;
  for (std::size_t step = 0; step < known_.size(); ++step) {
    const RowKey key = known_[cursor_];
    const bool own = key.writer == kOwn;
    const bool empty = !own && writers_[key.writer].rows[key.path].visits == 0;
    const bool there = own && sent_[key.path].in_batch == batch->sequence;
    if (!empty && !there) {
      used += RowBytes(paths_->depth(key.path));
      if (used > byte_budget && added) return;
      batch->rows.push_back(Export(key.writer, key.path));
      added = true;
    }
    if (++cursor_ == known_.size()) {
      cursor_ = 0;
      ++rounds_;
    }
  }
}

StatisticsRow SharedStatistics::Export(int writer, PathId id) const {
  const Row& row = writers_[writer].rows[id];
  StatisticsRow out;
  out.writer = writers_[writer].id;
  out.path = paths_->PathOf(id);
  out.version = row.version;
  out.visits = row.visits;
  out.value_sum = row.value_sum;
  out.best = row.best;
  out.in_flight = writer == kOwn ? row.in_flight : 0;
  return out;
}

WriterTotals SharedStatistics::own_totals() const {
  const Writer& own = writers_[kOwn];
  WriterTotals totals;
  if (!own.rows.empty()) {
    totals.rollouts = own.rows[kRoot].visits;
    totals.in_flight = own.rows[kRoot].in_flight;
  }
  totals.evaluations = own_evaluations_;
  totals.rows = own.count;
  totals.digest = own.digest;
  totals.finished = finished_;
  return totals;
}

// --- inspection

std::vector<WriterView> SharedStatistics::writers() const {
  std::vector<WriterView> views;
  for (std::size_t i = 0; i < writers_.size(); ++i) {
    const Writer& writer = writers_[i];
    const bool own = i == kOwn;
    views.push_back({writer.id, writer.live, own || writer.sequence > 0,
                     own ? own_totals() : writer.announced, writer.count, writer.digest});
  }
  std::sort(views.begin() + 1, views.end(),
            [](const WriterView& a, const WriterView& b) { return a.id < b.id; });
  return views;
}

bool SharedStatistics::ConvergedWithLive() const {
  const std::vector<WriterView> views = writers();
  return std::all_of(views.begin(), views.end(),
                     [](const WriterView& view) { return !view.live || view.Converged(); });
}

std::vector<StatisticsRow> SharedStatistics::AllRows() const {
  std::vector<StatisticsRow> all;
  for (const RowKey& key : known_) {
    const Row& row = writers_[key.writer].rows[key.path];
    if (row.visits == 0) continue;
    all.push_back(Export(key.writer, key.path));
    all.back().in_flight = row.in_flight;
  }
  std::sort(all.begin(), all.end(), [](const StatisticsRow& a, const StatisticsRow& b) {
    return std::tie(a.path, a.writer) < std::tie(b.path, b.writer);
  });
  return all;
}

}  // namespace prospect::planner

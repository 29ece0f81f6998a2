#include "planner/shared_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
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

SharedStatistics::Row& SharedStatistics::OwnRow(PathId id) {
  if (id >= static_cast<int>(own_rows_.size())) own_rows_.resize(paths_->size());
  return own_rows_[id];
}

void SharedStatistics::Begin(PathId id) {
  Row& row = OwnRow(id);
  ++row.in_flight;
  ++TotalsOf(id).in_flight;
  Touch(id, &row);
}

void SharedStatistics::Cancel(PathId id) {
  Row& row = OwnRow(id);
  --row.in_flight;
  --TotalsOf(id).in_flight;
  Touch(id, &row);
}

void SharedStatistics::Complete(PathId id, double value) {
  Row& row = OwnRow(id);
  const auto units = static_cast<std::int64_t>(value * static_cast<double>(kValueOne) + 0.5);
  const auto rounded = static_cast<float>(static_cast<double>(units) / kValueOne);
  writers_[kOwn].count += row.visits == 0 ? 1 : 0;
  --row.in_flight;
  ++row.visits;
  row.value_sum += units;
  row.best = std::max(row.best, rounded);
  writers_[kOwn].digest -= row.digest;
  row.digest = RowDigest(row, id);
  writers_[kOwn].digest += row.digest;

  PathTotals& totals = TotalsOf(id);
  NoteFirstVisit(id, totals.visits);
  --totals.in_flight;
  ++totals.visits;
  totals.value_sum += units;
  totals.best = std::max(totals.best, row.best);
  Touch(id, &row);
}

void SharedStatistics::Touch(PathId id, Row* row) {
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
  return id >= 0 && id < static_cast<int>(own_rows_.size()) ? own_rows_[id].in_flight : 0;
}

std::int64_t SharedStatistics::own_visits(PathId id) const {
  return id >= 0 && id < static_cast<int>(own_rows_.size()) ? own_rows_[id].visits : 0;
}

SharedStatistics::Row& SharedStatistics::RowOf(int writer, PathId id) {
  if (writer == kOwn) return OwnRow(id);
  const std::uint32_t found = other_index_.Find(writer, id);
  if (found != RowIndex::kNone) return other_rows_[found];
  other_index_.Add(writer, id, static_cast<std::uint32_t>(other_rows_.size()));
  writers_[writer].paths.push_back(id);
  return other_rows_.emplace_back();
}

const SharedStatistics::Row* SharedStatistics::FindRow(int writer, PathId id) const {
  if (writer == kOwn) return id < static_cast<int>(own_rows_.size()) ? &own_rows_[id] : nullptr;
  const std::uint32_t found = other_index_.Find(writer, id);
  return found == RowIndex::kNone ? nullptr : &other_rows_[found];
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

// --- what is heard of others not by rows

bool SharedStatistics::Announce(std::uint64_t writer, PathId leaf, PathId above, int sign) {
  if (writer == 0 || writer == options_.writer || !RoomFor(writer)) return false;
  const int index = WriterIndex(writer);
  for (PathId id = leaf; id != above && id != kNoPath; id = paths_->parent(id)) {
    Row& row = RowOf(index, id);
    if (row.announced + sign < 0) continue;  // a row has come since
    row.announced += sign;
    TotalsOf(id).announced += sign;
  }
  return true;
}

// What was known beside N of `before` and is not in `row`. A relayed row says nothing of visits in
// flight, which go on.
std::int32_t SharedStatistics::NotCovered(const Row& before, const Row& row, bool live) {
  if (row.direct) return 0;
  const std::int64_t beside = before.announced + (live ? before.in_flight : 0);
  const std::int64_t left = beside - (row.visits - before.visits);
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(left, 0, beside));
}

// --- merging

int SharedStatistics::Merge(const StatisticsBatch& batch, std::int64_t now_us) {
  ExpireLeases(now_us);
  if (!AcceptBatch(batch)) return 0;
  NoteHeard(batch, now_us);
  int changed = 0;
  std::uint64_t writer = batch.writer;  // rows of one writer stand together
  int index = WriterIndex(writer);
  for (const StatisticsRow& row : batch.rows) {
    if (!Sound(row)) continue;
    if (row.writer != writer) index = WriterIndex(writer = row.writer);
    if (MergeRow(row, index, row.writer == batch.writer)) ++changed;
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
  const int index = WriterIndex(batch.writer);
  Writer& writer = writers_[index];
  if (batch.sequence <= writer.sequence) return;
  if (writer.sequence == 0) TellAll();
  writer.sequence = batch.sequence;
  writer.heard_us = now_us;
  writer.announced = batch.totals;
  SetLive(index, true);
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
      static_cast<int>(writers_.size()) < options_.max_writers || writer_index_.contains(writer);
  if (!room) ++refusals_.writers;
  return room;
}

bool SharedStatistics::MergeRow(const StatisticsRow& row, int writer, bool direct) {
  const PathId id = paths_->Add(row.path);
  const Row known = RowOf(writer, id);
  if (writer == kOwn) {
    if (row.visits > known.visits) ++refusals_.own_row;
    return false;
  }
  const bool newer = row.version > known.version, older = row.version < known.version;
  if (row.version > 0 && known.version > 0 &&
      ((newer && row.visits < known.visits) || (older && row.visits > known.visits))) {
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
  return ReplaceRow(writer, id, fresh);
}

// Returns whether anything but the version changed.
bool SharedStatistics::ReplaceRow(int writer, PathId id, const Row& fresh) {
  Row& row = RowOf(writer, id);
  const Row before = row;
  row = fresh;
  row.known = before.known;
  row.announced = NotCovered(before, row, writers_[writer].live);
  row.digest = RowDigest(row, id);
  NoteKnown(writer, id, &row);
  writers_[writer].digest += row.digest - before.digest;
  writers_[writer].count += (row.visits > 0 ? 1 : 0) - (before.visits > 0 ? 1 : 0);

  PathTotals& totals = TotalsOf(id);
  if (row.visits > 0) NoteFirstVisit(id, totals.visits);
  totals.visits += row.visits - before.visits;
  totals.announced += row.announced - before.announced;
  totals.value_sum += row.value_sum - before.value_sum;
  if (writers_[writer].live) totals.in_flight += row.in_flight - before.in_flight;
  // An honest writer's v* only grows; a dishonest one must still leave the maximum of all rows.
  totals.best = row.best >= before.best ? std::max(totals.best, row.best) : BestOverWriters(id);
  return row.digest != before.digest || row.in_flight != before.in_flight;
}

float SharedStatistics::BestOverWriters(PathId id) const {
  float best = 0;
  for (std::size_t writer = 0; writer < writers_.size(); ++writer) {
    const Row* row = FindRow(static_cast<int>(writer), id);
    if (row != nullptr) best = std::max(best, row->best);
  }
  return best;
}

int SharedStatistics::WriterIndex(std::uint64_t id) {
  const auto found = writer_index_.find(id);
  if (found != writer_index_.end()) return found->second;
  const int index = static_cast<int>(writers_.size());
  writers_.emplace_back().id = id;
  writer_index_[id] = index;
  TellAll();  // known by a relay alone, perhaps: others may not know of it, either
  return index;
}

// --- leases

void SharedStatistics::ExpireLeases(std::int64_t now_us) {
  for (std::size_t i = kOwn + 1; i < writers_.size(); ++i) {
    const Writer& writer = writers_[i];
    const bool silent = now_us - writer.heard_us > options_.lease_us;
    if (writer.live && silent) SetLive(static_cast<int>(i), false);
  }
}

void SharedStatistics::SetLive(int index, bool live) {
  Writer& writer = writers_[index];
  if (writer.live == live) return;
  writer.live = live;
  const int sign = live ? 1 : -1;
  live_writers_ += sign;
  for (const PathId id : writer.paths) {
    Row& row = RowOf(index, id);
    if (row.in_flight != 0) TotalsOf(id).in_flight += sign * row.in_flight;
    if (live || row.announced == 0) continue;
    TotalsOf(id).announced -= row.announced;
    row.announced = 0;
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
  const std::size_t allowed = Allowance(byte_budget);
  const std::size_t for_rows = allowed > kBatchHeaderBytes ? allowed - kBatchHeaderBytes : 0;
  const std::size_t changed = AddChanged(for_rows - for_rows / 4, &batch);
  const std::size_t repeated = AddRoundRobin(for_rows / 4, &batch);
  const std::size_t used = kBatchHeaderBytes + changed + repeated;
  allowance_ -= std::min(allowance_, used);
  const auto place = [this](const StatisticsRow& row) {
    return std::make_tuple(row.writer != options_.writer, row.writer, std::cref(row.path));
  };
  std::sort(batch.rows.begin(), batch.rows.end(),
            [&](const auto& a, const auto& b) { return place(a) < place(b); });
  batch.checksum = PayloadChecksum(batch);
  return batch;
}

void SharedStatistics::TellAll() { full_until_round_ = rounds_ + 2; }

// What this batch may take of `byte_budget`: while rollouts go on, what they have earned.
std::size_t SharedStatistics::Allowance(std::size_t byte_budget) {
  constexpr std::size_t kAFewRows = kBatchHeaderBytes + 128;
  const std::int64_t rollouts = own_totals().rollouts;
  const auto earned = static_cast<std::size_t>(rollouts - allowed_rollouts_);
  allowed_rollouts_ = rollouts;
  allowance_ = std::min(byte_budget, allowance_ + earned * options_.bytes_per_rollout);
  const bool steady = options_.bytes_per_rollout > 0 && !finished_ && rounds_ >= full_until_round_;
  return steady ? std::min(byte_budget, std::max(allowance_, kAFewRows)) : byte_budget;
}

// Rows whose content differs from what was last sent, most important first, a few more than fit.
std::vector<PathId> SharedStatistics::ChangedRows(std::size_t most) {
  const std::vector<Row>& rows = own_rows_;
  const auto unsent = [&](PathId id) { return rows[id].visits - sent_[id].visits; };
  const auto same = [&](PathId id) {
    return unsent(id) == 0 && rows[id].in_flight == sent_[id].in_flight;
  };
  const auto first_same =
      std::stable_partition(dirty_.begin(), dirty_.end(), [&](PathId id) { return !same(id); });
  for (auto it = first_same; it != dirty_.end(); ++it) sent_[*it].dirty = false;
  dirty_.erase(first_same, dirty_.end());

  std::vector<PathId> chosen(std::min(dirty_.size(), most));
  // A child's unsent N is never above its parent's, and its id is higher: parents come first.
  std::partial_sort_copy(dirty_.begin(), dirty_.end(), chosen.begin(), chosen.end(),
                         [&](PathId a, PathId b) {
                           return std::make_pair(-unsent(a), a) < std::make_pair(-unsent(b), b);
                         });
  return chosen;
}

// Both return the bytes they took.
std::size_t SharedStatistics::AddChanged(std::size_t byte_budget, StatisticsBatch* batch) {
  constexpr std::size_t kShortestRow = 4;
  std::size_t used = 0;
  for (const PathId id : ChangedRows(byte_budget / kShortestRow + 1)) {
    StatisticsRow row = Export(kOwn, id);
    const std::size_t bytes = RowBytes(row, false);
    if (used + bytes > byte_budget && used > 0) break;
    used += bytes;
    sent_[id].visits = row.visits;
    sent_[id].in_flight = row.in_flight;
    sent_[id].in_batch = batch->sequence;
    batch->rows.push_back(std::move(row));
  }
  return used;
}

std::size_t SharedStatistics::AddRoundRobin(std::size_t byte_budget, StatisticsBatch* batch) {
  std::size_t used = 0;
  for (std::size_t step = 0; step < known_.size(); ++step) {
    const RowKey key = known_[cursor_];
    const bool own = key.writer == kOwn;
    const bool empty = !own && FindRow(key.writer, key.path)->visits == 0;
    const bool there = own && sent_[key.path].in_batch == batch->sequence;
    if (!empty && !there) {
      StatisticsRow row = Export(key.writer, key.path);
      const std::size_t bytes = RowBytes(row, !own);
      if (used + bytes > byte_budget && used > 0) return used;
      used += bytes;
      batch->rows.push_back(std::move(row));
    }
    if (++cursor_ == known_.size()) {
      cursor_ = 0;
      ++rounds_;
    }
  }
  return used;
}

StatisticsRow SharedStatistics::Export(int writer, PathId id) const {
  const Row& row = *FindRow(writer, id);
  StatisticsRow out;
  out.writer = writers_[writer].id;
  out.path = paths_->PathOf(id);
  out.version = writer == kOwn ? sequence_ : 0;
  out.visits = row.visits;
  out.value_sum = row.value_sum;
  out.best = row.best;
  out.in_flight = writer == kOwn ? row.in_flight : 0;
  return out;
}

WriterTotals SharedStatistics::own_totals() const {
  const Writer& own = writers_[kOwn];
  WriterTotals totals;
  if (!own_rows_.empty()) {
    totals.rollouts = own_rows_[kRoot].visits;
    totals.in_flight = own_rows_[kRoot].in_flight;
  }
  totals.evaluations = own_evaluations_;
  totals.rows = own.count;
  totals.digest = own.digest;
  totals.finished = finished_;
  totals.claimed = claimed_;
  totals.round = round_;
  return totals;
}

// --- inspection

WriterView SharedStatistics::ViewOf(int index) const {
  const Writer& writer = writers_[index];
  const bool own = index == kOwn;
  const Row* root = FindRow(index, kRoot);
  WriterView view;
  view.id = writer.id;
  view.live = writer.live;
  view.heard = own || writer.sequence > 0;
  view.announced = own ? own_totals() : writer.announced;
  view.rows = writer.count;
  view.digest = writer.digest;
  view.rollouts = root == nullptr ? 0 : root->visits;
  return view;
}

std::vector<WriterView> SharedStatistics::others() const {
  std::vector<WriterView> views;
  for (std::size_t i = kOwn + 1; i < writers_.size(); ++i) {
    views.push_back(ViewOf(static_cast<int>(i)));
  }
  return views;
}

std::vector<WriterView> SharedStatistics::writers() const {
  std::vector<WriterView> views = others();
  std::sort(views.begin(), views.end(),
            [](const WriterView& a, const WriterView& b) { return a.id < b.id; });
  views.insert(views.begin(), ViewOf(kOwn));
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
    const Row& row = *FindRow(key.writer, key.path);
    if (row.visits == 0) continue;
    all.push_back(Export(key.writer, key.path));
    all.back().in_flight = row.in_flight;
    if (key.writer != kOwn) all.back().version = row.version;
  }
  std::sort(all.begin(), all.end(), [](const StatisticsRow& a, const StatisticsRow& b) {
    return std::tie(a.path, a.writer) < std::tie(b.path, b.writer);
  });
  return all;
}

}  // namespace prospect::planner

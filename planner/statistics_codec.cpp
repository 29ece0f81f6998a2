#include "planner/statistics_codec.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace prospect::planner {
namespace {

constexpr std::uint8_t kWriterFollows = 0x80;
constexpr std::uint8_t kInFlightFollows = 0x40;
constexpr std::uint8_t kOneAction = 0x20;
constexpr std::uint8_t kSharedMask = 0x1f;

std::size_t VarintBytes(std::uint64_t number) {
  std::size_t bytes = 1;
  while (number >>= 7) ++bytes;
  return bytes;
}

std::uint64_t BestUnits(const StatisticsRow& row) {
  return static_cast<std::uint64_t>(std::llround(static_cast<double>(row.best) * kValueOne));
}

// --- writing

class Writer {
 public:
  explicit Writer(std::vector<std::uint8_t>* out) : out_(out) {}
  void Byte(std::uint8_t byte) { out_->push_back(byte); }
  void Varint(std::uint64_t number) {
    for (; number >= 0x80; number >>= 7) Byte(static_cast<std::uint8_t>(number | 0x80));
    Byte(static_cast<std::uint8_t>(number));
  }
  void Fixed64(std::uint64_t number) {
    for (int i = 0; i < 8; ++i, number >>= 8) Byte(static_cast<std::uint8_t>(number));
  }

 private:
  std::vector<std::uint8_t>* out_;
};

std::vector<std::uint64_t> OtherWriters(const StatisticsBatch& batch) {
  std::vector<std::uint64_t> others;
  for (const StatisticsRow& row : batch.rows) {
    if (row.writer != batch.writer) others.push_back(row.writer);
  }
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
  return others;
}

std::size_t PlaceOf(std::uint64_t writer, const std::vector<std::uint64_t>& others,
                    std::uint64_t sender) {
  if (writer == sender) return 0;
  return 1 + static_cast<std::size_t>(std::lower_bound(others.begin(), others.end(), writer) -
                                      others.begin());
}

std::size_t SharedLength(const Path& a, const Path& b) {
  const std::size_t limit = std::min({a.size(), b.size(), std::size_t{kSharedMask}});
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.begin() + limit, b.begin()).first -
                                  a.begin());
}

void WriteNumbers(const StatisticsRow& row, Writer* to) {
  to->Varint(static_cast<std::uint64_t>(row.visits));
  if (row.visits > 0) to->Varint(static_cast<std::uint64_t>(row.value_sum));
  if (row.visits > 1) to->Varint(BestUnits(row));
  if (row.in_flight > 0) to->Varint(static_cast<std::uint64_t>(row.in_flight));
}

void WriteRow(const StatisticsRow& row, const Path& before, bool same_writer, std::size_t place,
              Writer* to) {
  const std::size_t shared = SharedLength(before, row.path);
  const std::size_t suffix = row.path.size() - shared;
  to->Byte(static_cast<std::uint8_t>(shared | (same_writer ? 0 : kWriterFollows) |
                                     (row.in_flight > 0 ? kInFlightFollows : 0) |
                                     (suffix == 1 ? kOneAction : 0)));
  if (!same_writer) to->Varint(place);
  if (suffix != 1) to->Varint(suffix);
  for (std::size_t i = shared; i < row.path.size(); ++i) to->Byte(row.path[i]);
  WriteNumbers(row, to);
}

// --- reading

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes)
      : next_(bytes.data()), end_(bytes.data() + bytes.size()) {}
  bool ok() const { return ok_; }
  bool at_end() const { return next_ == end_; }
  std::size_t left() const { return static_cast<std::size_t>(end_ - next_); }
  void Fail() { ok_ = false; }

  std::uint8_t Byte() {
    if (at_end()) ok_ = false;
    return ok_ ? *next_++ : 0;
  }
  // At most `limit`, which is below 2^63.
  std::uint64_t Varint(std::uint64_t limit) {
    std::uint64_t number = 0;
    for (int shift = 0; ok_; shift += 7) {
      const std::uint8_t byte = Byte();
      number |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) break;
      if (shift >= 56) ok_ = false;
    }
    if (number > limit) ok_ = false;
    return ok_ ? number : 0;
  }
  std::uint64_t Fixed64() {
    std::uint64_t number = 0;
    for (int i = 0; i < 8; ++i) number |= static_cast<std::uint64_t>(Byte()) << (8 * i);
    return number;
  }

 private:
  const std::uint8_t* next_;
  const std::uint8_t* end_;
  bool ok_ = true;
};

constexpr std::uint64_t kMaxNumber = std::uint64_t{1} << 62;

std::vector<std::uint64_t> ReadTable(std::uint64_t sender, Reader* from) {
  std::vector<std::uint64_t> writers{sender};
  const std::uint64_t others = from->Varint(from->left() / 8);
  for (std::uint64_t i = 0; i < others && from->ok(); ++i) writers.push_back(from->Fixed64());
  return writers;
}

void ReadPath(std::uint8_t head, Path* path, Reader* from) {
  const std::size_t shared = head & kSharedMask;
  const std::size_t suffix = (head & kOneAction) != 0 ? 1 : from->Varint(kMaxPathLength);
  if (shared > path->size() || shared + suffix > kMaxPathLength) from->Fail();
  if (!from->ok()) return;
  path->resize(shared);
  for (std::size_t i = 0; i < suffix; ++i) path->push_back(from->Byte());
}

void ReadNumbers(std::uint8_t head, StatisticsRow* row, Reader* from) {
  row->visits = static_cast<std::int64_t>(from->Varint(kMaxNumber));
  if (row->visits > 0) row->value_sum = static_cast<std::int64_t>(from->Varint(kMaxNumber));
  const std::uint64_t best =
      row->visits > 1 ? from->Varint(kValueOne) : static_cast<std::uint64_t>(row->value_sum);
  if (best > static_cast<std::uint64_t>(kValueOne)) from->Fail();
  row->best = static_cast<float>(static_cast<double>(best) / kValueOne);
  if ((head & kInFlightFollows) != 0) {
    row->in_flight = static_cast<std::int32_t>(from->Varint(std::numeric_limits<int>::max()));
  }
}

}  // namespace

std::size_t RowBytes(const StatisticsRow& row, bool relayed) {
  std::size_t bytes = 2 + VarintBytes(static_cast<std::uint64_t>(row.visits)) + (relayed ? 1 : 0);
  // Beyond what a head can say is shared, the rest is written out after its length.
  if (row.path.size() > kSharedMask + std::size_t{1}) bytes += row.path.size() - kSharedMask;
  if (row.visits > 0) bytes += VarintBytes(static_cast<std::uint64_t>(row.value_sum));
  if (row.visits > 1) bytes += VarintBytes(BestUnits(row));
  return bytes + (row.in_flight > 0 ? VarintBytes(static_cast<std::uint64_t>(row.in_flight)) : 0);
}

std::vector<std::uint8_t> PackRows(const StatisticsBatch& batch) {
  const std::vector<std::uint64_t> others = OtherWriters(batch);
  std::vector<std::uint8_t> bytes;
  Writer to(&bytes);
  to.Varint(others.size());
  for (const std::uint64_t other : others) to.Fixed64(other);
  const Path nothing;
  const Path* before = &nothing;
  std::uint64_t writer = batch.writer;
  for (const StatisticsRow& row : batch.rows) {
    WriteRow(row, *before, row.writer == writer, PlaceOf(row.writer, others, batch.writer), &to);
    before = &row.path;
    writer = row.writer;
  }
  return bytes;
}

bool UnpackRows(std::span<const std::uint8_t> bytes, StatisticsBatch* batch) {
  batch->rows.clear();
  Reader from(bytes);
  const std::vector<std::uint64_t> writers = ReadTable(batch->writer, &from);
  Path path;
  std::size_t place = 0;
  while (from.ok() && !from.at_end()) {
    const std::uint8_t head = from.Byte();
    if ((head & kWriterFollows) != 0) place = from.Varint(writers.size() - 1);
    ReadPath(head, &path, &from);
    StatisticsRow row;
    row.writer = writers[place];
    row.path = path;
    row.version = place == 0 ? batch->sequence : 0;
    ReadNumbers(head, &row, &from);
    if (from.ok()) batch->rows.push_back(std::move(row));
  }
  if (!from.ok()) batch->rows.clear();
  return from.ok();
}

}  // namespace prospect::planner

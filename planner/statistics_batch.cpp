#include "planner/statistics_batch.h"

#include <cstring>

namespace prospect::planner {
namespace {

std::uint64_t Bits(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

// Folds numbers in order; a named object reads better than a chain of nested calls.
class Checksum {
 public:
  template <typename Number>
  void Add(Number number) {
    sum_ = HashCombine(sum_, static_cast<std::uint64_t>(number));
  }
  std::uint64_t sum() const { return sum_; }

 private:
  std::uint64_t sum_ = 0x50726f7370656374ULL;
};

void AddTotals(const WriterTotals& totals, Checksum* sum) {
  sum->Add(totals.rollouts);
  sum->Add(totals.evaluations);
  sum->Add(totals.in_flight);
  sum->Add(totals.rows);
  sum->Add(totals.digest);
  sum->Add(totals.finished ? 1 : 0);
  sum->Add(totals.claimed);
  sum->Add(totals.round);
}

void AddRow(const StatisticsRow& row, Checksum* sum) {
  sum->Add(row.writer);
  sum->Add(row.path.size());
  sum->Add(HashPath(row.path));
  sum->Add(row.visits);
  sum->Add(row.value_sum);
  sum->Add(Bits(row.best));
  sum->Add(row.in_flight);
}

}  // namespace

std::uint64_t PayloadChecksum(const StatisticsBatch& batch) {
  Checksum sum;
  sum.Add(batch.search.id);
  sum.Add(batch.search.epoch);
  sum.Add(batch.writer);
  sum.Add(batch.sequence);
  AddTotals(batch.totals, &sum);
  sum.Add(batch.rows.size());
  for (const StatisticsRow& row : batch.rows) AddRow(row, &sum);
  return sum.sum();
}

}  // namespace prospect::planner

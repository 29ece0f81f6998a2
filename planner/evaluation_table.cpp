#include "planner/evaluation_table.h"

#include <cstring>

namespace prospect::planner {
namespace {

std::uint32_t Bits(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

}  // namespace

EvaluationTable::EvaluationTable(PathTree* paths)
    : paths_(paths), num_actions_(paths->num_actions()) {}

Stored EvaluationTable::Put(PathId id, const Evaluation& evaluation, std::uint64_t fingerprint) {
  if (id >= static_cast<int>(slots_.size())) slots_.resize(paths_->size(), -1);
  int& slot = slots_[id];
  if (slot < 0) {
    slot = size();
    entries_.emplace_back();
    numbers_.resize(numbers_.size() + 2 * static_cast<std::size_t>(num_actions_));
    Write(slot, evaluation, fingerprint);
    return Stored::kNew;
  }
  if (!Lower(evaluation, fingerprint, entries_[slot])) return Stored::kDuplicate;
  Write(slot, evaluation, fingerprint);
  return Stored::kReplaced;
}

bool EvaluationTable::Lower(const Evaluation& evaluation, std::uint64_t fingerprint,
                            const Entry& known) const {
  if (fingerprint != known.fingerprint) return fingerprint < known.fingerprint;
  return Bits(evaluation.value) < Bits(known.value);
}

void EvaluationTable::Write(int slot, const Evaluation& evaluation, std::uint64_t fingerprint) {
  entries_[slot] = {evaluation.value, evaluation.done, fingerprint};
  float* numbers = &numbers_[static_cast<std::size_t>(slot) * 2 * num_actions_];
  for (int a = 0; a < num_actions_; ++a) {
    numbers[a] = Dequantize(Quantize(evaluation.q[a]));
    numbers[num_actions_ + a] = Dequantize(Quantize(evaluation.p[a]));
  }
}

Evaluation EvaluationTable::Get(PathId id) const {
  Evaluation result;
  result.value = value(id);
  result.done = done(id);
  result.q.assign(q(id), q(id) + num_actions_);
  result.p.assign(p(id), p(id) + num_actions_);
  return result;
}

}  // namespace prospect::planner

// Path -> Evaluation, filled by whoever evaluates. Of two evaluations of one path the lower
// (fingerprint, bits of V) stays, so that processes that heard both, in either order, agree
// (engines may differ in the last bits). Not thread safe. Refers to a PathTree that must outlive
// it; owns the numbers. Reading is O(1).
#pragma once

#include <cstdint>
#include <vector>

#include "planner/evaluation.h"
#include "planner/path_tree.h"

namespace prospect::planner {

enum class Stored { kNew, kReplaced, kDuplicate };

class EvaluationTable {
 public:
  explicit EvaluationTable(PathTree* paths);

  // `fingerprint`: the engine's (hash of a fixed probe); the evaluation must have no Defect. Q and
  // p are stored as on the wire. kReplaced: an evaluation was known and this one is lower;
  // kDuplicate: the known one stays.
  Stored Put(PathId id, const Evaluation& evaluation, std::uint64_t fingerprint);

  bool Has(PathId id) const { return Slot(id) >= 0; }
  // The rest needs Has(id).
  float value(PathId id) const { return entries_[Slot(id)].value; }
  float done(PathId id) const { return entries_[Slot(id)].done; }
  std::uint64_t fingerprint(PathId id) const { return entries_[Slot(id)].fingerprint; }
  const float* q(PathId id) const { return &numbers_[Offset(id)]; }  // num_actions numbers
  const float* p(PathId id) const {
    return &numbers_[Offset(id) + num_actions_];
  }  // num_actions numbers
  Evaluation Get(PathId id) const;

  int size() const { return static_cast<int>(entries_.size()); }

 private:
  struct Entry {
    float value;
    float done;
    std::uint64_t fingerprint;
  };

  int Slot(PathId id) const { return id < static_cast<int>(slots_.size()) ? slots_[id] : -1; }
  std::size_t Offset(PathId id) const {
    return static_cast<std::size_t>(Slot(id)) * 2 * num_actions_;
  }
  bool Lower(const Evaluation& evaluation, std::uint64_t fingerprint, const Entry& known) const;
  void Write(int slot, const Evaluation& evaluation, std::uint64_t fingerprint);

  PathTree* paths_;
  int num_actions_;
  std::vector<int> slots_;      // by path id: index into entries_, or -1
  std::vector<Entry> entries_;  // in order of arrival
  std::vector<float> numbers_;  // for each entry: num_actions Q, then num_actions p
};

}  // namespace prospect::planner

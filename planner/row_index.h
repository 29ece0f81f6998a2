// (writer index, path id) -> place of a row, for rows that are never removed. A hash table with
// open addressing: finding a row is what merging does most, and with the tables of 16 workers one
// that lies in one piece takes a third of the time of std::unordered_map. Plain value; not thread
// safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/path_tree.h"

namespace prospect::planner {

class RowIndex {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  // writer >= 0, id >= 0. kNone if it was never added.
  std::uint32_t Find(int writer, PathId id) const {
    return slots_.empty() ? kNone : slots_[SlotOf(KeyOf(writer, id))].place;
  }
  // The key must be new; place < kNone.
  void Add(int writer, PathId id, std::uint32_t place) {
    if (2 * (size_ + 1) > slots_.size()) Grow();
    Put({KeyOf(writer, id), place});
    ++size_;
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t place = kNone;
  };

  static std::uint64_t KeyOf(int writer, PathId id) {
    return static_cast<std::uint64_t>(writer) << 32 | static_cast<std::uint32_t>(id);
  }
  // Where the key stands, or the free slot where it would.
  std::size_t SlotOf(std::uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (key * 0x9e3779b97f4a7c15u) >> shift_;
    while (slots_[slot].place != kNone && slots_[slot].key != key) slot = (slot + 1) & mask;
    return slot;
  }
  void Put(const Slot& filled) { slots_[SlotOf(filled.key)] = filled; }
  void Grow() {
    std::vector<Slot> before(slots_.empty() ? kFirstSize : 2 * slots_.size());
    before.swap(slots_);
    shift_ = before.empty() ? 64 - kFirstBits : shift_ - 1;
    for (const Slot& slot : before) {
      if (slot.place != kNone) Put(slot);
    }
  }

  static constexpr int kFirstBits = 6;
  static constexpr std::size_t kFirstSize = std::size_t{1} << kFirstBits;
  std::vector<Slot> slots_;  // a power of two, at most half of them filled
  std::size_t size_ = 0;
  int shift_ = 64;  // the upper bits of the product say where to begin
};

}  // namespace prospect::planner

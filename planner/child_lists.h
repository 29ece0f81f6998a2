// For each node whose children were ever compared, the children that may be chosen: what the task
// allows and p permits, with what does not change about them, so that a selection reads numbers
// that lie side by side. Filled and asked by Search; not thread safe.
#pragma once

#include <cstdint>
#include <vector>

#include "planner/evaluation_table.h"
#include "planner/path_tree.h"

namespace prospect::planner {

struct ChildEntry {
  std::uint64_t tie;   // ChildView::tie
  std::uint64_t draw;  // ChildView::draw
  double q;            // ChildView::q
  PathId id;           // kNoPath until it was first chosen or heard of
  std::uint8_t action;
};

class ChildLists {
 public:
  struct List {
    std::int32_t first = 0;  // into the entries
    std::int32_t count = -1;
    double q_sum = 0;
  };

  // `tie_seed`: hash of search seed and worker; `draw_seed`: of the search seed alone.
  ChildLists(std::uint64_t tie_seed, std::uint64_t draw_seed)
      : tie_seed_(tie_seed), draw_seed_(draw_seed) {}

  bool Has(PathId id) const {
    return id < static_cast<int>(lists_.size()) && lists_[id].count >= 0;
  }
  // The node's evaluation was replaced: its list is to be made anew.
  void Forget(PathId id);

  // Makes an empty list for `id` (0 <= id < paths.size()); Append adds to the list made last.
  void Open(PathId id, const PathTree& paths);
  void Append(const PathTree& paths, PathId id, int action, double q);

  const List& Of(PathId id) const { return lists_[id]; }
  ChildEntry* Entries(const List& list) { return entries_.data() + list.first; }

 private:
  std::uint64_t tie_seed_;
  std::uint64_t draw_seed_;
  std::vector<List> lists_;  // by path id
  std::vector<ChildEntry> entries_;
};

}  // namespace prospect::planner

// What nobody has looked at yet: the part of planner/search.h that a best-first rule asks for.
#include <algorithm>

#include "planner/search.h"

namespace prospect::planner {
namespace {

// An action that Q gives no hope is open all the same.
constexpr double kLeastHope = 1e-3;

// What another rollout waits for is left to it, unless there is nothing else.
constexpr double kTaken = 1e-3;

}  // namespace

// Product of f along the path: how likely all its actions succeed.
double Search::Reach(PathId id) const {
  double reach = 1;
  for (; id != kRoot; id = paths_.parent(id)) {
    if (evaluations_.Has(id)) reach *= evaluations_.done(id);
  }
  return reach;
}

// Of one child: f along the path times Q where it is not known, else what is open below it.
double Search::OpenChild(double reach, const ChildEntry& entry) const {
  const PathId id = entry.id;
  if (id != kNoPath && evaluations_.Has(id)) return nodes_[id].open;
  const double hope = reach * std::max(entry.q, kLeastHope);
  const bool known = id != kNoPath && id < static_cast<int>(nodes_.size());
  return known && nodes_[id].pending != Pending::kNo ? hope * kTaken : hope;
}

// The highest of what is open below a node whose evaluation is known; 0: all of it was followed to
// its end.
double Search::OpenBelow(PathId id) {
  double value = 0;
  const double reach = Reach(id);
  if (EndsHere(id, &value)) return statistics_.totals(id).visits > 0 ? 0 : reach * kTaken;
  ListChildren(id);
  const ChildLists::List list = children_.Of(id);
  ChildEntry* entries = children_.Entries(list);
  double open = 0;
  for (int i = 0; i < list.count; ++i) {
    if (entries[i].id == kNoPath) entries[i].id = paths_.Find(id, entries[i].action);
    open = std::max(open, OpenChild(reach, entries[i]));
  }
  return open;
}

// Something was heard of `id`, or is waited for there: its ancestors may be less open than before.
void Search::UpdateOpen(PathId id) {
  if (!rule_->asks_for_open()) return;
  if (evaluations_.Has(id)) NodeOf(id).open = OpenBelow(id);
  for (id = paths_.parent(id); id != kNoPath && evaluations_.Has(id); id = paths_.parent(id)) {
    const double open = OpenBelow(id);
    if (open == NodeOf(id).open) return;
    nodes_[id].open = open;
  }
}

}  // namespace prospect::planner

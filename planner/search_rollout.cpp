// One rollout: the parts of planner/search.h that walk down the tree and back up.
#include "planner/search.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace prospect::planner {

Search::Node& Search::NodeOf(PathId id) {
  if (id >= static_cast<int>(nodes_.size())) nodes_.resize(paths_.size());
  return nodes_[id];
}

// What the task allows after a node, worked out when a rollout first gets there.
void Search::ResolveRules(PathId id) {
  if (NodeOf(id).first_allowed >= 0) return;
  const Path path = paths_.PathOf(id);
  Node& node = NodeOf(id);
  node.complete = rules_.Complete(executed_, path);
  node.first_allowed = static_cast<std::int32_t>(allowed_.size());
  for (const int action : rules_.AllowedActions(executed_, path)) {
    allowed_.push_back(static_cast<std::uint8_t>(action));
    ++node.num_allowed;
  }
}

// EVALUATE: the node's value if nothing below it is to be explored. Needs the node's evaluation.
bool Search::EndsHere(PathId id, double* value) {
  ResolveRules(id);
  const float v = evaluations_.value(id);
  *value = v;
  if (id != kRoot) {
    if (evaluations_.done(id) < parameters_.c_done) {
      *value = 0;
      return true;
    }
    if (v < parameters_.v_failed) return true;
  }
  return nodes_[id].complete || paths_.depth(id) >= depth_;
}

bool Search::Permitted(PathId id, int action) const {
  return evaluations_.p(id)[action] >= parameters_.p_min;
}

// What may be chosen after a node, listed when a rollout first chooses there.
void Search::ListChildren(PathId id) {
  if (children_.Has(id)) return;
  children_.Open(id, paths_);
  const Node node = nodes_[id];
  for (int i = 0; i < node.num_allowed; ++i) {
    const int action = allowed_[node.first_allowed + i];
    if (Permitted(id, action)) {
      children_.Append(paths_, id, action, evaluations_.q(id)[action]);
    }
  }
}

// SAMPLE: the best permitted child, or kNoPath. `before`: others that choose here just before this
// rollout, of whom nothing was heard yet; in the end, those of them that went the same way.
PathId Search::SelectChild(PathId id, std::int64_t* before) {
  ListChildren(id);
  const ChildLists::List list = children_.Of(id);
  if (list.count == 0) return kNoPath;
  ChildEntry* entries = children_.Entries(list);
  ViewChildren(id, entries, list.count);
  ParentView parent = ViewOf(id, list);
  if (*before > 0) taken_.assign(list.count, 0);
  for (std::int64_t i = 0; i < *before; ++i) {
    const int other = Best(parent, entries, list.count);
    ++views_[other].in_flight;
    ++parent.in_flight;
    ++taken_[other];
  }
  const int best = Best(parent, entries, list.count);
  if (*before > 0) *before = taken_[best];
  ChildEntry& chosen = entries[best];
  if (chosen.id == kNoPath) chosen.id = paths_.Add(id, chosen.action);
  return chosen.id;
}

int Search::Best(const ParentView& parent, const ChildEntry* entries, int count) {
  const auto children = static_cast<std::size_t>(count);
  rule_->ScoreAll(parent, std::span(views_).first(children), std::span(scores_).first(children));
  int best = 0;
  for (int i = 1; i < count; ++i) {
    const bool tie = scores_[i] == scores_[best];
    if (scores_[i] > scores_[best] || (tie && entries[i].tie > entries[best].tie)) best = i;
  }
  return best;
}

ParentView Search::ViewOf(PathId id, const ChildLists::List& list) const {
  const PathTotals& totals = statistics_.totals(id);
  ParentView view{};
  view.visits = totals.visits;
  view.in_flight = totals.in_flight + totals.announced;
  view.mean = totals.visits > 0 ? totals.mean() : evaluations_.value(id);
  view.q_sum = list.q_sum;
  view.root = id == kRoot;
  view.samples = Budget();
  return view;
}

// Fills views_, and finds children that others' rows have added since the list was made.
void Search::ViewChildren(PathId id, ChildEntry* entries, int count) {
  if (static_cast<int>(views_.size()) < count) views_.resize(count), scores_.resize(count);
  const bool alone = statistics_.live_writers() == 1;
  const bool open = rule_->asks_for_open();
  const double reach = open ? Reach(id) : 0;
  for (int i = 0; i < count; ++i) {
    ChildEntry& entry = entries[i];
    if (entry.id == kNoPath) entry.id = paths_.Find(id, entry.action);
    ChildView& view = views_[i];
    view = {entry.q, 0, 0, 0, 0, open ? OpenChild(reach, entry) : 0, entry.tie, entry.draw};

    if (entry.id == kNoPath) continue;
    const PathTotals& totals = statistics_.totals(entry.id);
    view.in_flight = alone ? totals.in_flight +
                                 std::max<std::int64_t>(totals.announced, AskedElsewhere(entry.id))
                           : statistics_.own_in_flight(entry.id) + InFlightOfOthers(entry.id);
    if (totals.visits == 0) continue;
    view.visits = totals.visits;
    view.mean = totals.mean();
    view.best = totals.best;
  }
}

// What their rows say and what was heard since.
std::int64_t Search::InFlightOfOthers(PathId id) const {
  if (id == kNoPath) return 0;
  const PathTotals& totals = statistics_.totals(id);
  const std::int64_t told = totals.in_flight + totals.announced - statistics_.own_in_flight(id);
  return told > 0 ? told : std::max(AskedElsewhere(id), VisitedElsewhere(id, totals));
}

// Whether another worker waits for it.
std::int64_t Search::AskedElsewhere(PathId id) const {
  return id < static_cast<int>(nodes_.size()) && nodes_[id].pending == Pending::kForeign ? 1 : 0;
}

// An evaluation that nobody here asked for is a visit whose row is still on its way.
std::int64_t Search::VisitedElsewhere(PathId id, const PathTotals& totals) const {
  return totals.visits == 0 && totals.in_flight == 0 && evaluations_.Has(id) ? 1 : 0;
}

// Walks on from `*at` as far as evaluations go. kEnded: `*value` is EVALUATE's result for the last
// node. `before`: as for SelectChild, at the first node.
Search::Walked Search::Walk(std::int64_t before, PathId* at, double* value) {
  while (evaluations_.Has(*at)) {
    if (EndsHere(*at, value)) return Walked::kEnded;
    const PathId child = SelectChild(*at, &before);
    if (child == kNoPath) {
      *value = 0;
      return Walked::kEnded;
    }
    *at = child;
    statistics_.Begin(*at);
  }
  return Walked::kBlocked;
}

// UPDATE, from the last node to the root.
void Search::BackUp(PathId leaf, double value) {
  const bool by_plan_score = rule_->backup() == Backup::kPlanScore;
  if (by_plan_score && leaf != kRoot) value *= evaluations_.done(leaf);
  statistics_.Complete(leaf, value);
  for (PathId id = paths_.parent(leaf); id != kNoPath; id = paths_.parent(id)) {
    if (!by_plan_score) {
      value *= evaluations_.value(id);
    } else if (id != kRoot) {
      value *= evaluations_.done(id);
    }
    statistics_.Complete(id, value);
  }
}

void Search::GiveUp(PathId leaf) {
  for (PathId id = leaf; id != kNoPath; id = paths_.parent(id)) statistics_.Cancel(id);
}

// --- what is wholly known

void Search::Absorb() {
  for (const PathId id : statistics_.TakeNewlyVisited()) {
    UpdateExhausted(id);
    UpdateOpen(id);
  }
}

void Search::UpdateExhausted(PathId id) {
  while (id != kNoPath && !NodeOf(id).exhausted && NowExhausted(id)) {
    nodes_[id].exhausted = true;
    id = paths_.parent(id);
  }
}

bool Search::Exhausted(PathId id) const {
  return id != kNoPath && id < static_cast<int>(nodes_.size()) && nodes_[id].exhausted;
}

bool Search::NowExhausted(PathId id) {
  if (!evaluations_.Has(id) || statistics_.totals(id).visits == 0) return false;
  double value = 0;
  if (EndsHere(id, &value)) return true;
  const Node& node = nodes_[id];
  for (int i = 0; i < node.num_allowed; ++i) {
    const int action = allowed_[node.first_allowed + i];
    if (Permitted(id, action) && !Exhausted(paths_.Find(id, action))) return false;
  }
  return true;
}

}  // namespace prospect::planner

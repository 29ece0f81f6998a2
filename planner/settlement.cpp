#include "planner/settlement.h"

#include <algorithm>
#include <vector>

namespace prospect::planner {
namespace {

class DecisionReader {
 public:
  explicit DecisionReader(const PlanSource& source)
      : s_(source),
        done_product_(source.paths->size(), -1.0),
        open_bound_(source.rules->num_actions, 0.0) {}

  Decision Read() {
    for (PathId id = kRoot; id < s_.paths->size(); ++id) Visit(id);
    Decision decision;
    if (best_ < 0 || best_ < s_.parameters->refusal_threshold) return decision;
    decision.first_action = first_;
    decision.proven = true;
    for (int a = 0; a < s_.rules->num_actions; ++a) {
      if (a != first_ && open_bound_[a] > best_) decision.proven = false;
    }
    return decision;
  }

 private:
  bool Counted(PathId id) const {
    return s_.evaluations->Has(id) && s_.statistics->totals(id).visits > 0;
  }

  // f along the path, or below 0 for a future that is not followed. Parents' ids are lower.
  double DoneProduct(PathId id) const {
    if (id == kRoot) return 1;
    const PathId parent = s_.paths->parent(id);
    const double above = done_product_[parent];
    if (above < 0 || !Counted(id)) return -1;
    const bool permitted = s_.evaluations->p(parent)[s_.paths->action(id)] >= s_.parameters->p_min;
    const float done = s_.evaluations->done(id);
    const bool failed =
        done < s_.parameters->c_done || s_.evaluations->value(id) < s_.parameters->v_failed;
    return permitted && !failed ? above * done : -1;
  }

  int FirstAction(PathId id) const {
    while (s_.paths->depth(id) > 1) id = s_.paths->parent(id);
    return s_.paths->action(id);
  }

  void Visit(PathId id) {
    if (!Counted(id)) return;
    done_product_[id] = DoneProduct(id);
    if (done_product_[id] < 0) return;
    const Path path = s_.paths->PathOf(id);
    const bool ended =
        s_.rules->Complete(s_.executed, path) || s_.paths->depth(id) >= s_.parameters->depth;
    if (ended) {
      const double score = done_product_[id] * s_.evaluations->value(id);
      if (score > best_) best_ = score, first_ = id == kRoot ? -1 : FirstAction(id);
      return;
    }
    for (const int action : s_.rules->AllowedActions(s_.executed, path)) Look(id, action);
  }

  // An action that nobody tried leaves its future open.
  void Look(PathId id, int action) {
    if (s_.evaluations->p(id)[action] < s_.parameters->p_min) return;
    const PathId child = s_.paths->Find(id, action);
    if (child != kNoPath && Counted(child)) return;
    double& bound = open_bound_[id == kRoot ? action : FirstAction(id)];
    bound = std::max(bound, done_product_[id]);
  }

  const PlanSource& s_;
  std::vector<double> done_product_;
  std::vector<double> open_bound_;  // by first action: what an open future may score at most
  double best_ = -1;
  int first_ = -1;
};

}  // namespace

Decision ReadDecision(const PlanSource& source) { return DecisionReader(source).Read(); }

void Settlement::Update(const PlanSource& source, std::int64_t rollouts) {
  if (!Due(rollouts)) return;
  next_look_ = rollouts + rollouts / 8 + 1;
  const Decision decision = ReadDecision(source);
  if (decision.first_action != first_action_) unchanged_since_ = rollouts;
  first_action_ = decision.first_action;
  const bool stable =
      stable_for_ > 0 && first_action_ >= 0 && rollouts - unchanged_since_ >= stable_for_;
  settled_ = stable || (wants_proof_ && decision.proven);
}

}  // namespace prospect::planner

#include "planner/search.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace prospect::planner {
namespace {

TaskRules Checked(TaskRules rules) {
  rules.Validate();
  return rules;
}

SearchParameters Checked(SearchParameters parameters) {
  parameters.Validate();
  return parameters;
}

int DepthLeft(const TaskRules& rules, const SearchParameters& parameters, const Path& executed) {
  const int left = rules.plan_length - static_cast<int>(executed.size());
  return std::max(0, std::min(parameters.depth, left));
}

SharedStatisticsOptions StatisticsOptions(const SearchIdentity& identity) {
  SharedStatisticsOptions options;
  options.search = identity.search;
  options.writer = identity.writer;
  options.lease_us = identity.lease_us;
  return options;
}

}  // namespace

const char* ToString(StopReason reason) {
  switch (reason) {
    case StopReason::kRunning:
      return "running";
    case StopReason::kSamples:
      return "samples";
    case StopReason::kExhausted:
      return "exhausted";
    case StopReason::kDeadline:
      return "deadline";
    case StopReason::kStopped:
      return "stopped";
  }
  return "unknown";
}

Search::Search(TaskRules rules, SearchParameters parameters, Path executed, SearchIdentity identity)
    : rules_(Checked(std::move(rules))),
      parameters_(Checked(std::move(parameters))),
      executed_(std::move(executed)),
      identity_(identity),
      depth_(DepthLeft(rules_, parameters_, executed_)),
      rule_(MakeSelectionRule(parameters_.rule, parameters_.c, parameters_.c_puct)),
      paths_(rules_.num_actions),
      evaluations_(&paths_),
      statistics_(&paths_, StatisticsOptions(identity)),
      tie_seed_(HashCombine(parameters_.seed, static_cast<std::uint64_t>(identity.worker_index))),
      quota_(parameters_.samples) {
  if (!PathTree(rules_.num_actions).Valid(executed_)) {
    throw std::invalid_argument("executed actions are not of this task: " + ToString(executed_));
  }
}

// --- what is heard

Delivery Search::Deliver(const Path& path, const Evaluation& evaluation,
                         std::uint64_t fingerprint) {
  const bool sound = *Defect(evaluation, rules_.num_actions) == '\0';
  if (!sound || path.size() > kMaxPathLength || !rules_.Legal(executed_, path)) {
    return Delivery::kRefused;
  }
  const PathId id = paths_.Add(path);
  const Stored stored = evaluations_.Put(id, evaluation, fingerprint);
  Node& node = NodeOf(id);
  if (node.pending == Pending::kOwn) ++own_evaluations_;
  node.pending = Pending::kNo;
  UpdateExhausted(id);
  if (stored == Stored::kNew) return Delivery::kNew;
  return stored == Stored::kReplaced ? Delivery::kReplaced : Delivery::kDuplicate;
}

void Search::NoteRequested(const std::vector<Path>& paths, std::int64_t now_us) {
  for (const Path& path : paths) {
    if (path.size() > kMaxPathLength || !rules_.Legal(executed_, path)) continue;
    const PathId id = paths_.Add(path);
    Node& node = NodeOf(id);
    if (evaluations_.Has(id) || node.pending == Pending::kOwn) continue;
    node.pending = Pending::kForeign;
    node.pending_since_us = now_us;
  }
}

int Search::Merge(const StatisticsBatch& batch, std::int64_t now_us) {
  const int changed = statistics_.Merge(batch, now_us);
  quota_ = std::min(quota_, FairShare());  // others were faster than the last tick knew
  Absorb();
  return changed;
}

// --- one rollout

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

// SAMPLE: the best permitted child, or kNoPath. Exhausted children come last where they are to be
// skipped.
PathId Search::SelectChild(PathId id) {
  const ParentView parent = ViewOf(id);
  int best_action = -1;
  std::tuple<bool, double, std::uint64_t> best;
  const Node node = nodes_[id];
  for (int i = 0; i < node.num_allowed; ++i) {
    const int action = allowed_[node.first_allowed + i];
    if (!Permitted(id, action)) continue;
    const PathId child = paths_.Find(id, action);
    const ChildView view = ViewOfChild(id, action, child);
    const bool fresh = !parameters_.skip_exhausted || !Exhausted(child);
    const auto ranked = std::make_tuple(fresh, rule_->Score(parent, view), view.tie);
    if (best_action >= 0 && ranked <= best) continue;
    best = ranked;
    best_action = action;
  }
  return best_action < 0 ? kNoPath : paths_.Add(id, best_action);
}

ParentView Search::ViewOf(PathId id) const {
  const PathTotals& totals = statistics_.totals(id);
  const Node& node = nodes_[id];
  ParentView view{};
  view.visits = totals.visits;
  view.in_flight = totals.in_flight;
  view.mean = totals.visits > 0 ? totals.mean() : evaluations_.value(id);
  for (int i = 0; i < node.num_allowed; ++i) {
    const int action = allowed_[node.first_allowed + i];
    if (Permitted(id, action)) view.q_sum += evaluations_.q(id)[action];
  }
  return view;
}

ChildView Search::ViewOfChild(PathId parent, int action, PathId child) const {
  const PathTotals& totals = statistics_.totals(child);
  ChildView view;
  view.q = evaluations_.q(parent)[action];
  view.visits = totals.visits;
  view.in_flight = totals.in_flight + ExtraInFlight(child);
  view.mean = totals.mean();
  view.best = totals.best;
  view.tie = HashCombine(tie_seed_, ExtendHash(paths_.hash(parent), action));
  return view;
}

// A path that another worker asked for counts as one visit until that worker's own rows say so.
std::int64_t Search::ExtraInFlight(PathId child) const {
  if (child == kNoPath || child >= static_cast<int>(nodes_.size())) return 0;
  if (nodes_[child].pending != Pending::kForeign) return 0;
  const bool said = statistics_.totals(child).in_flight > statistics_.own_in_flight(child);
  return said ? 0 : 1;
}

// Walks on from `*at` as far as evaluations go. kEnded: `*value` is EVALUATE's result for the last
// node.
Search::Walked Search::Walk(PathId* at, double* value) {
  while (evaluations_.Has(*at)) {
    if (EndsHere(*at, value)) return Walked::kEnded;
    const PathId child = SelectChild(*at);
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

// --- many rollouts

std::vector<Path> Search::Advance(int max_new_leaves, std::int64_t now_us) {
  std::vector<Path> requests;
  if (stopped_) return requests;
  statistics_.ExpireLeases(now_us);
  const int ended = ResumeRollouts(now_us, &requests);
  StartRollouts(max_new_leaves + ended, now_us, &requests);
  return requests;
}

// Returns how many of the rollouts in flight ended.
int Search::ResumeRollouts(std::int64_t now_us, std::vector<Path>* requests) {
  std::size_t kept = 0;
  for (PathId at : rollouts_) {
    double value = 0;
    if (Walk(&at, &value) == Walked::kEnded) {
      BackUp(at, value);
      continue;
    }
    Request(at, now_us, requests);
    rollouts_[kept++] = at;
  }
  const int ended = static_cast<int>(rollouts_.size() - kept);
  rollouts_.resize(kept);
  Absorb();
  return ended;
}

// A rollout whose leaf is already asked for keeps its place in the counts until the end of this
// call, so that the next one looks elsewhere, and is then given up.
void Search::StartRollouts(int max_new_leaves, std::int64_t now_us, std::vector<Path>* requests) {
  int asked = 0;
  while (asked < max_new_leaves && MayStart(now_us)) {
    PathId at = kRoot;
    double value = 0;
    statistics_.Begin(at);
    --quota_;
    if (Walk(&at, &value) == Walked::kEnded) {
      BackUp(at, value);
      Absorb();
    } else if (Request(at, now_us, requests)) {
      rollouts_.push_back(at);
      ++asked;
    } else {
      given_up_.push_back(at);
    }
  }
  for (const PathId leaf : given_up_) GiveUp(leaf);
  quota_ += static_cast<std::int64_t>(given_up_.size());
  given_up_.clear();
}

bool Search::MayStart(std::int64_t now_us) const {
  if (static_cast<int>(given_up_.size()) > parameters_.collisions) return false;
  const bool in_turn = quota_ > 0 || statistics_.live_writers() == 1;
  return in_turn && !done(now_us);
}

// Of the rollouts that remain, this worker's part, rounded up.
std::int64_t Search::FairShare() const {
  const PathTotals& root = statistics_.totals(kRoot);
  const std::int64_t live = statistics_.live_writers();
  const std::int64_t left = parameters_.samples - root.visits - root.in_flight;
  return (std::max<std::int64_t>(left, 0) + live - 1) / live;
}

// T: asks for a path unless somebody just did. Returns whether it asked.
bool Search::Request(PathId id, std::int64_t now_us, std::vector<Path>* requests) {
  Node& node = NodeOf(id);
  if (node.pending == Pending::kOwn) return false;
  const bool fresh = now_us - node.pending_since_us < parameters_.patience_us;
  if (node.pending == Pending::kForeign && fresh) return false;
  node.pending = Pending::kOwn;
  node.pending_since_us = now_us;
  requests->push_back(paths_.PathOf(id));
  return true;
}

StatisticsBatch Search::MakeBatch(std::size_t byte_budget, std::int64_t now_us) {
  statistics_.SetOwnEvaluations(own_evaluations_);
  statistics_.SetFinished(finished(now_us));
  StatisticsBatch batch = statistics_.MakeBatch(byte_budget, now_us);
  quota_ = FairShare();
  return batch;
}

std::vector<Path> Search::MissingEvaluations(int limit) const {
  std::vector<Path> missing;
  for (PathId id = kRoot; id < paths_.size() && static_cast<int>(missing.size()) < limit; ++id) {
    if (evaluations_.Has(id) || statistics_.totals(id).visits == 0) continue;
    const Path path = paths_.PathOf(id);
    if (rules_.Legal(executed_, path)) missing.push_back(path);
  }
  return missing;
}

// --- what is wholly known

void Search::Absorb() {
  for (const PathId id : statistics_.TakeNewlyVisited()) UpdateExhausted(id);
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

// --- ending

void Search::Abandon(const Path& path) {
  const PathId id = paths_.Find(path);
  if (id == kNoPath || evaluations_.Has(id)) return;
  NodeOf(id).pending = Pending::kNo;
  const auto waits = [id](PathId at) { return at == id; };
  for (const PathId at : rollouts_) {
    if (waits(at)) GiveUp(at);
  }
  rollouts_.erase(std::remove_if(rollouts_.begin(), rollouts_.end(), waits), rollouts_.end());
}

void Search::Stop() {
  stopped_ = true;
  for (const PathId at : rollouts_) GiveUp(at);
  rollouts_.clear();
}

StopReason Search::stop_reason(std::int64_t now_us) const {
  if (stopped_) return StopReason::kStopped;
  if (parameters_.deadline_us > 0 && now_us >= parameters_.deadline_us)
    return StopReason::kDeadline;
  if (Exhausted(kRoot)) return StopReason::kExhausted;
  const PathTotals& root = statistics_.totals(kRoot);
  const bool enough = root.visits + root.in_flight >= parameters_.samples;
  return enough ? StopReason::kSamples : StopReason::kRunning;
}

// --- the answer, and counts

Plan Search::BestPlan() const {
  PlanSource source;
  source.paths = &paths_;
  source.evaluations = &evaluations_;
  source.statistics = &statistics_;
  source.rules = &rules_;
  source.parameters = &parameters_;
  source.executed = executed_;
  return ReadPlan(source);
}

std::int64_t Search::rollouts() const { return statistics_.own_totals().rollouts; }

std::int64_t Search::total_rollouts() const { return statistics_.totals(kRoot).visits; }

}  // namespace prospect::planner

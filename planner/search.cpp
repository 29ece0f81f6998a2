#include "planner/search.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planner/plan_reader.h"

namespace prospect::planner {
namespace {

// Of SEARCH_STATISTICS, while rollouts go on: what 4 workers at 200 rollouts/s each cost a bus is
// then 50 kB/s.
constexpr std::size_t kBytesPerRollout = 54;

// A worker that waits for the others' claims repeats its own this often: one of them was lost.
constexpr std::int64_t kRepeatUs = 20'000;

TaskRules Checked(TaskRules rules) {
  rules.Prepare();
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
  options.bytes_per_rollout = kBytesPerRollout;
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
      claims_(parameters_.samples),
      children_(HashCombine(parameters_.seed, static_cast<std::uint64_t>(identity.worker_index)),
                parameters_.seed),
      foreign_(&paths_, &statistics_) {
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
  if (stored == Stored::kReplaced) children_.Forget(id);
  if (NodeOf(id).pending == Pending::kOwn) ++own_evaluations_;
  SetPending(id, Pending::kNo, 0);
  NoteEnded(id, foreign_.Answer(id));
  UpdateExhausted(id);
  UpdateOpen(id);
  if (stored == Stored::kNew) return Delivery::kNew;
  return stored == Stored::kReplaced ? Delivery::kReplaced : Delivery::kDuplicate;
}

void Search::NoteRequested(const std::vector<Path>& paths, std::int64_t now_us,
                           std::uint64_t writer) {
  if (Apart()) return;
  for (const Path& path : paths) {
    if (path.size() > kMaxPathLength || !rules_.Legal(executed_, path)) continue;
    const PathId id = paths_.Add(path);
    const bool answered = evaluations_.Has(id);
    if (writer != 0) {
      foreign_.Hear(writer, id, answered, now_us);
      NoteBegun(writer);
    }
    if (answered) continue;
    if (NodeOf(id).pending == Pending::kOwn) {
      if (writer != 0) OneStays(writer, id);
      continue;
    }
    SetPending(id, Pending::kForeign, now_us);
  }
}

// `writer` waited for what was just answered. If its rollout ends there, it begins another now.
void Search::NoteEnded(PathId id, std::uint64_t writer) {
  double value = 0;
  if (writer != 0 && advanced_ && EndsHere(id, &value)) freed_.push_back(writer);
}

void Search::NoteBegun(std::uint64_t writer) {
  const auto freed = std::find(freed_.begin(), freed_.end(), writer);
  if (freed != freed_.end()) freed_.erase(freed);
}

// One answer frees many workers at once, which all choose from the same numbers. They would all go
// the same way, so they take turns: by id, as far as they know of each other.
std::int64_t Search::OthersBefore() const {
  return std::count_if(freed_.begin(), freed_.end(),
                       [this](std::uint64_t writer) { return writer < identity_.writer; });
}

// This worker and another wait for one path: the same rollout would count twice.
void Search::OneStays(std::uint64_t writer, PathId id) {
  if (writer < identity_.writer) {
    LeaveTo(id);
  } else {
    foreign_.GiveUp(writer, id);
  }
}

int Search::Merge(const StatisticsBatch& batch, std::int64_t now_us) {
  if (Apart()) return 0;
  if (parameters_.sharing) claims_.Share(OwnBegun(), now_us);
  const int changed = statistics_.Merge(batch, now_us);
  foreign_.Forget(now_us - parameters_.patience_us);
  Absorb();
  return changed;
}

// A worker in a tree of its own. Who only watches takes in everybody's rows.
bool Search::Apart() const { return !parameters_.sharing && advanced_; }

// --- many rollouts

std::vector<Path> Search::Advance(int max_new_leaves, std::int64_t now_us) {
  std::vector<Path> requests;
  advanced_ = true;
  if (stopped_) return requests;
  statistics_.ExpireLeases(now_us);
  StartRollouts(max_new_leaves + ResumeRollouts(now_us, &requests), now_us, &requests);
  freed_.clear();
  if (finished(now_us) && !announced_finished_) hurried_ = true;
  return requests;
}

// Returns how many of the rollouts in flight ended.
int Search::ResumeRollouts(std::int64_t now_us, std::vector<Path>* requests) {
  std::size_t kept = 0;
  for (PathId at : rollouts_) {
    double value = 0;
    if (Walk(0, &at, &value) == Walked::kEnded) {
      BackUp(at, value);
    } else if (!Request(at, now_us, requests) && NodeOf(at).pending != Pending::kOwn) {
      GiveUp(at);  // somebody else's rollout waits there
    } else {
      rollouts_[kept++] = at;
    }
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
    if (Walk(OthersBefore(), &at, &value) == Walked::kEnded) {
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
  given_up_.clear();
}

bool Search::MayStart(std::int64_t now_us) {
  if (static_cast<int>(given_up_.size()) > parameters_.collisions) return false;
  return !done(now_us) && MayClaim(now_us);
}

bool Search::MayClaim(std::int64_t now_us) {
  if (!parameters_.sharing || claims_.Covers(OwnBegun())) return true;
  const bool news = claims_.news();
  claims_.Renew(OwnBegun(), statistics_.others(), now_us);
  const bool covered = claims_.Covers(OwnBegun());
  const bool waits = !covered && now_us - announced_us_ >= kRepeatUs;
  if ((!news && claims_.news()) || waits) hurried_ = true;
  return covered;
}

// T: asks for a path unless somebody just did. Returns whether it asked.
bool Search::Request(PathId id, std::int64_t now_us, std::vector<Path>* requests) {
  const Node& node = NodeOf(id);
  if (node.pending == Pending::kOwn) return false;
  const bool fresh = now_us - node.pending_since_us < parameters_.patience_us;
  if (node.pending == Pending::kForeign && fresh) return false;
  SetPending(id, Pending::kOwn, now_us);
  requests->push_back(paths_.PathOf(id));
  return true;
}

void Search::SetPending(PathId id, Pending pending, std::int64_t now_us) {
  Node& node = NodeOf(id);
  node.pending = pending;
  node.pending_since_us = now_us;
  UpdateOpen(id);
}

StatisticsBatch Search::MakeBatch(std::size_t byte_budget, std::int64_t now_us) {
  if (parameters_.sharing) {
    statistics_.ExpireLeases(now_us);
    claims_.Share(OwnBegun(), now_us);
    claims_.Renew(OwnBegun(), statistics_.others(), now_us);
    claims_.NoteAnnounced();
    announced_us_ = now_us;
  }
  hurried_ = false;
  statistics_.SetClaim(claims_.claimed(), claims_.round());
  statistics_.SetOwnEvaluations(own_evaluations_);
  announced_finished_ = finished(now_us);
  statistics_.SetFinished(announced_finished_);
  return statistics_.MakeBatch(byte_budget, now_us);
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

// --- ending

void Search::Abandon(const Path& path) {
  const PathId id = paths_.Find(path);
  if (id == kNoPath || evaluations_.Has(id)) return;
  SetPending(id, Pending::kNo, 0);
  LeaveTo(id);
}

// Gives up the rollouts that wait for `id`.
void Search::LeaveTo(PathId id) {
  for (auto given_up = std::erase(rollouts_, id); given_up > 0; --given_up) GiveUp(id);
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
  const std::int64_t begun = Apart() ? OwnBegun() : root.visits + root.in_flight;
  return begun >= Budget() ? StopReason::kSamples : StopReason::kRunning;
}

// Rollouts that are to be done in the tree this search looks at.
std::int64_t Search::Budget() const {
  const std::int64_t workers = Apart() ? parameters_.workers : 1;
  return (parameters_.samples + workers - 1) / workers;
}

// Own N + O at the root.
std::int64_t Search::OwnBegun() const {
  const WriterTotals totals = statistics_.own_totals();
  return totals.rollouts + totals.in_flight;
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

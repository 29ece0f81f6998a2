#include "planner/plan_reader.h"

#include <algorithm>
#include <tuple>

#include "base/number_format.h"

namespace prospect::planner {
namespace {

constexpr int kDigits = 3;

// A future before it is written out: a node, and for one that was not permitted the action from
// there.
struct Candidate {
  PathId id;
  int action;  // -1, or an action that p excludes
  Rejection rejection;
  double score;
  std::int64_t visits;
  Path path;
};

// Goes over the tree once, parents before children (their ids are lower), and sorts every future
// into a list.
class Reader {
 public:
  explicit Reader(const PlanSource& source)
      : s_(source), live_(source.paths->size(), false), done_product_(source.paths->size(), 1.0) {}

  Plan Read();

 private:
  bool Counted(PathId id) const;
  std::int64_t Visits(PathId id) const;
  bool Ended(const Path& path) const;
  Rejection Judge(PathId id) const;
  double Score(PathId id) const;
  void Visit(PathId id);
  void VisitLive(PathId id, const Path& path);
  void LookAhead(PathId id, const Path& path);
  void Reject(PathId id, int action, Rejection rejection, const Path& path);
  Future WriteOut(const Candidate& candidate) const;
  PlanStep WriteStep(PathId id) const;
  std::vector<Future> WriteOut(const std::vector<Candidate>& list, std::size_t skip) const;
  void Conclude();
  void ConcludeWithoutEnd();

  const PlanSource& s_;
  std::vector<char> live_;            // may be followed further, or is a complete future
  std::vector<double> done_product_;  // f along the path
  std::vector<Candidate> good_;
  std::vector<Candidate> bad_;
  std::vector<Candidate> open_;  // live nodes with actions that nobody tried
  Plan plan_;
};

bool Better(const Candidate& a, const Candidate& b) {
  return std::tie(b.score, b.visits, a.path) < std::tie(a.score, a.visits, b.path);
}

bool Further(const Candidate& a, const Candidate& b) {
  const std::size_t a_size = a.path.size(), b_size = b.path.size();
  return a_size != b_size ? a_size > b_size : Better(a, b);
}

std::string After(const char* words, const std::string& text) {
  return text.empty() ? "" : words + text;
}

// "2 with an action that would not finish (f < 0.100)"; nothing for none.
std::string Counted(std::int64_t count, const char* what, const char* bound, double limit) {
  if (count == 0) return "";
  return std::to_string(count) + what + " (" + bound + " < " + base::Fixed(limit, kDigits) + ")";
}

bool Reader::Counted(PathId id) const {
  if (!s_.evaluations->Has(id)) return false;
  return s_.statistics == nullptr || s_.statistics->totals(id).visits > 0;
}

std::int64_t Reader::Visits(PathId id) const {
  return s_.statistics == nullptr ? 0 : s_.statistics->totals(id).visits;
}

bool Reader::Ended(const Path& path) const {
  return s_.rules->Complete(s_.executed, path) ||
         static_cast<int>(path.size()) >= s_.parameters->depth;
}

double Reader::Score(PathId id) const { return done_product_[id] * s_.evaluations->value(id); }

Rejection Reader::Judge(PathId id) const {
  if (id == kRoot) return Rejection::kNone;
  if (s_.evaluations->done(id) < s_.parameters->c_done) return Rejection::kNotDone;
  if (s_.evaluations->value(id) < s_.parameters->v_failed) return Rejection::kLowValue;
  return Rejection::kNone;
}

Plan Reader::Read() {
  if (!Counted(kRoot)) {
    plan_.reason = "the scene itself was not evaluated: is a model server running?";
    return plan_;
  }
  plan_.root_value = s_.evaluations->value(kRoot);
  for (PathId id = kRoot; id < s_.paths->size(); ++id) Visit(id);
  Conclude();
  return plan_;
}

void Reader::Visit(PathId id) {
  if (!Counted(id)) return;
  const Path path = s_.paths->PathOf(id);
  if (id != kRoot) {
    const PathId parent = s_.paths->parent(id);
    const int action = s_.paths->action(id);
    const Path before(path.begin(), path.end() - 1);
    if (!live_[parent] || Ended(before)) return;
    if (!s_.rules->Allowed(s_.executed, before, action)) return;
    if (s_.evaluations->p(parent)[action] < s_.parameters->p_min) return;
    done_product_[id] = done_product_[parent] * s_.evaluations->done(id);
  }
  const Rejection rejection = Judge(id);
  if (rejection == Rejection::kNone) {
    VisitLive(id, path);
  } else {
    Reject(id, -1, rejection, path);
  }
}

void Reader::VisitLive(PathId id, const Path& path) {
  live_[id] = true;
  if (!Ended(path)) {
    LookAhead(id, path);
    return;
  }
  ++plan_.complete_futures;
  if (Score(id) < s_.parameters->refusal_threshold) {
    Reject(id, -1, Rejection::kLowScore, path);
  } else {
    good_.push_back({id, -1, Rejection::kNone, Score(id), Visits(id), path});
  }
}

void Reader::LookAhead(PathId id, const Path& path) {
  bool open = false;
  for (const int action : s_.rules->AllowedActions(s_.executed, path)) {
    if (s_.evaluations->p(id)[action] < s_.parameters->p_min) {
      Path there = path;
      there.push_back(static_cast<std::uint8_t>(action));
      Reject(id, action, Rejection::kNotPermitted, there);
      continue;
    }
    const PathId child = s_.paths->Find(id, action);
    if (child != kNoPath && Counted(child)) continue;
    ++plan_.untried;
    open = true;
  }
  if (open) open_.push_back({id, -1, Rejection::kNone, Score(id), Visits(id), path});
}

void Reader::Reject(PathId id, int action, Rejection rejection, const Path& path) {
  const double score = action < 0 ? Score(id) : 0.0;
  const std::int64_t visits = action < 0 ? Visits(id) : 0;
  bad_.push_back({id, action, rejection, score, visits, path});
  if (rejection == Rejection::kNotPermitted) ++plan_.not_permitted;
  if (rejection == Rejection::kNotDone) ++plan_.not_done;
  if (rejection == Rejection::kLowValue) ++plan_.low_value;
  if (rejection == Rejection::kLowScore) ++plan_.low_score;
}

PlanStep Reader::WriteStep(PathId id) const {
  const PathId parent = s_.paths->parent(id);
  PlanStep step;
  step.action = s_.paths->action(id);
  step.value = s_.evaluations->value(id);
  step.done = s_.evaluations->done(id);
  step.prior = s_.evaluations->p(parent)[step.action];
  step.q = s_.evaluations->q(parent)[step.action];
  step.score = Score(id);
  step.visits = Visits(id);
  return step;
}

Future Reader::WriteOut(const Candidate& candidate) const {
  Future future;
  future.path = candidate.path;
  for (PathId id = candidate.id; id != kRoot; id = s_.paths->parent(id)) {
    future.steps.push_back(WriteStep(id));
  }
  std::reverse(future.steps.begin(), future.steps.end());
  if (candidate.action >= 0) {
    PlanStep& step = future.steps.emplace_back();
    step.action = candidate.action;
    step.done = 0;
    step.prior = s_.evaluations->p(candidate.id)[candidate.action];
    step.q = s_.evaluations->q(candidate.id)[candidate.action];
  }
  future.score = candidate.score;
  future.visits = candidate.visits;
  future.complete = s_.rules->Complete(s_.executed, candidate.path);
  future.rejection = candidate.rejection;
  return future;
}

std::vector<Future> Reader::WriteOut(const std::vector<Candidate>& list, std::size_t skip) const {
  std::vector<Future> futures;
  const std::size_t end = std::min(list.size(), skip + s_.parameters->listed_futures);
  for (std::size_t i = skip; i < end; ++i) futures.push_back(WriteOut(list[i]));
  return futures;
}

void Reader::Conclude() {
  std::sort(good_.begin(), good_.end(), Better);
  std::sort(bad_.begin(), bad_.end(), Further);
  plan_.rejected = WriteOut(bad_, 0);
  if (good_.empty()) {
    ConcludeWithoutEnd();
    return;
  }
  plan_.status = PlanStatus::kPlan;
  plan_.best = WriteOut(good_.front());
  plan_.runners_up = WriteOut(good_, 1);
}

// No future may be carried out: a refusal if all of them are known to fail, otherwise more samples
// are needed.
void Reader::ConcludeWithoutEnd() {
  const std::string tally = Tally(plan_, *s_.parameters);
  const auto low = std::min_element(bad_.begin(), bad_.end(), [](const auto& a, const auto& b) {
    const bool a_low = a.rejection == Rejection::kLowScore;
    const bool b_low = b.rejection == Rejection::kLowScore;
    return a_low != b_low ? a_low : Better(a, b);
  });
  if (plan_.low_score > 0) {
    plan_.status = PlanStatus::kRefused;
    plan_.best = WriteOut(*low);
    const double score = low->score, threshold = s_.parameters->refusal_threshold;
    plan_.reason = "the best of " + std::to_string(plan_.complete_futures) +
                   " complete futures scores " + base::Apart(score, threshold, kDigits) +
                   ", below the threshold of " + base::Apart(threshold, score, kDigits) +
                   After("; others: ", tally);
    return;
  }
  if (open_.empty()) {
    plan_.status = PlanStatus::kRefused;
    plan_.reason =
        tally.empty() ? "the task's rules allow no action here" : "every future fails: " + tally;
    return;
  }
  plan_.status = PlanStatus::kIncomplete;
  plan_.best = WriteOut(*std::min_element(open_.begin(), open_.end(), Further));
  plan_.reason = "no future was followed to its end, " + std::to_string(plan_.untried) +
                 " actions are untried: give more samples" + After("; so far: ", tally);
}

}  // namespace

std::string Tally(const Plan& plan, const SearchParameters& parameters) {
  std::string text;
  for (const std::string& item :
       {Counted(plan.not_permitted, " not permitted", "p", parameters.p_min),
        Counted(plan.not_done, " with an action that would not finish", "f", parameters.c_done),
        Counted(plan.low_value, " without hope", "V", parameters.v_failed)})
    text += item.empty() ? "" : (text.empty() ? "" : ", ") + item;
  return text;
}

Plan ReadPlan(const PlanSource& source) { return Reader(source).Read(); }

}  // namespace prospect::planner

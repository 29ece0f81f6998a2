#include "tools/figures/search_story.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/number_format.h"
#include "planner/search.h"
#include "tools/figures/cells.h"

namespace prospect::figures {

namespace {

constexpr int kAllFutures = 100000;

// Passes questions on and keeps them in order.
class Watcher : public planner::ModelSource {
 public:
  explicit Watcher(planner::ModelSource* model) : model_(model) {}
  planner::Evaluation Evaluate(const planner::Path& path) override {
    asked_.push_back(path);
    return model_->Evaluate(path);
  }
  const std::vector<planner::Path>& asked() const { return asked_; }

 private:
  planner::ModelSource* model_;
  std::vector<planner::Path> asked_;
};

bool Extends(const planner::Path& longer, const planner::Path& path) {
  return longer.size() == path.size() + 1 && std::equal(path.begin(), path.end(), longer.begin());
}

// The last path of each chain of questions that go one step further each.
std::vector<planner::Path> EndsOf(const std::vector<planner::Path>& asked) {
  std::vector<planner::Path> ends;
  for (const planner::Path& path : asked) {
    if (path.empty()) continue;
    if (!ends.empty() && Extends(path, ends.back())) {
      ends.back() = path;
    } else {
      ends.push_back(path);
    }
  }
  return ends;
}

Fate FateOf(planner::Rejection rejection) {
  switch (rejection) {
    case planner::Rejection::kNotDone:
      return Fate::kNotDone;
    case planner::Rejection::kLowValue:
      return Fate::kLowValue;
    case planner::Rejection::kLowScore:
      return Fate::kLowScore;
    case planner::Rejection::kNotPermitted:
    case planner::Rejection::kNone:
      break;
  }
  return Fate::kPossible;
}

planner::Rejection RejectionOf(Fate fate) {
  if (fate == Fate::kNotDone) return planner::Rejection::kNotDone;
  if (fate == Fate::kLowValue) return planner::Rejection::kLowValue;
  if (fate == Fate::kLowScore) return planner::Rejection::kLowScore;
  return planner::Rejection::kNone;
}

// What the plan reader says of each future that was followed to an end of its own.
std::map<planner::Path, Fate> FatesOf(const planner::Plan& plan) {
  std::map<planner::Path, Fate> fates;
  for (const auto* list : {&plan.runners_up, &plan.rejected}) {
    for (const planner::Future& future : *list) {
      if (future.rejection == planner::Rejection::kNotPermitted) continue;
      fates[future.path] = FateOf(future.rejection);
    }
  }
  if (plan.ok()) fates[plan.best.path] = Fate::kChosen;
  return fates;
}

// Of a future that did not end by itself: whether p rejects every action that may follow.
bool AllRefused(const TaskTable& table, const planner::Path& path, const planner::Evaluation& state,
                double p_min) {
  const std::vector<int> next = table.rules.AllowedActions({}, path);
  return std::all_of(next.begin(), next.end(),
                     [&](int action) { return state.p[static_cast<std::size_t>(action)] < p_min; });
}

Tried Describe(const planner::Path& path, int number, const std::map<planner::Path, Fate>& fates,
               const TaskTable& table, const planner::SearchParameters& parameters,
               planner::ModelSource* model) {
  Tried tried{path, number, Fate::kUnfinished, 1, {}};
  for (std::size_t n = 1; n <= path.size(); ++n) {
    tried.states.push_back(
        model->Evaluate({path.begin(), path.begin() + static_cast<std::ptrdiff_t>(n)}));
    tried.score *= tried.states.back().done;
  }
  const planner::Evaluation& last = tried.states.back();
  tried.score *= last.value;
  const auto known = fates.find(path);
  if (known != fates.end()) {
    tried.fate = known->second;
  } else if (AllRefused(table, path, last, parameters.p_min)) {
    tried.fate = Fate::kAllRefused;
  }
  return tried;
}

}  // namespace

bool IsRejection(Fate fate) {
  return fate == Fate::kNotDone || fate == Fate::kLowValue || fate == Fate::kLowScore ||
         fate == Fate::kAllRefused;
}

SearchStory WatchSearch(const TaskTable& table, const planner::SearchParameters& parameters,
                        planner::ModelSource* model) {
  planner::SearchParameters all = parameters;
  all.depth = std::min(all.depth, table.rules.plan_length);
  all.listed_futures = kAllFutures;
  planner::Search search(table.rules, all, {}, planner::SearchIdentity{});
  Watcher watcher(model);
  planner::RunSearch(&search, &watcher, 1);
  SearchStory story;
  story.plan = search.BestPlan();
  story.rollouts = search.rollouts();
  const auto fates = FatesOf(story.plan);
  int number = 0;
  for (const planner::Path& path : EndsOf(watcher.asked())) {
    story.tried.push_back(Describe(path, ++number, fates, table, parameters, model));
  }
  return story;
}

std::vector<Tried> ChooseTried(const SearchStory& story, int most) {
  std::vector<Tried> first_of_fate, others;
  std::set<Fate> seen;
  for (const Tried& tried : story.tried) {
    (seen.insert(tried.fate).second ? first_of_fate : others).push_back(tried);
  }
  std::vector<Tried> chosen = first_of_fate;
  chosen.insert(chosen.end(), others.begin(), others.end());
  chosen.resize(std::min(chosen.size(), static_cast<std::size_t>(most)));
  std::sort(chosen.begin(), chosen.end(), [](const Tried& a, const Tried& b) {
    const bool a_is_plan = a.fate == Fate::kChosen, b_is_plan = b.fate == Fate::kChosen;
    return a_is_plan != b_is_plan ? a_is_plan : a.number < b.number;
  });
  return chosen;
}

std::string Verdict(const Tried& tried, const SearchStory& story,
                    const planner::SearchParameters& parameters) {
  switch (tried.fate) {
    case Fate::kChosen:
      return base::Number("chosen: score %.2f", tried.score);
    case Fate::kPossible:
      return "possible, but less likely: score " + base::Number("%.2f", tried.score) +
             base::Number(" against %.2f", story.plan.best.score);
    case Fate::kAllRefused:
      return "rejected: p forbids every action that could follow" +
             base::Number(" (p < %.2f)", parameters.p_min);
    case Fate::kUnfinished:
      return "not followed to its end";
    case Fate::kNotDone:
    case Fate::kLowValue:
    case Fate::kLowScore:
      break;
  }
  return "rejected: " + WhyRejected(RejectionOf(tried.fate), static_cast<int>(tried.path.size()),
                                    tried.states.back(), tried.score, parameters);
}

}  // namespace prospect::figures

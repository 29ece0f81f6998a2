#include "tasks/plan_check.h"

#include <algorithm>
#include <cstddef>

#include "base/text.h"
#include "planner/path.h"

namespace prospect::tasks {
namespace {

constexpr int kMostTried = 200'000;  // paths of a search for one without repeats

const std::vector<int>& Row(const sim::TaskSpec& spec, int action) {
  return spec.successors.at(static_cast<std::size_t>(action));
}

bool Completes(const sim::TaskSpec& spec, int action) {
  const std::vector<int>& first = spec.successors.back();
  const std::vector<int>& row = Row(spec, action);
  return std::all_of(row.begin(), row.end(), [&](int next) {
    return std::find(first.begin(), first.end(), next) != first.end();
  });
}

std::vector<bool> Reached(const sim::TaskSpec& spec) {
  std::vector<bool> reached(spec.actions.size(), false);
  std::vector<int> left = spec.successors.back();
  while (!left.empty()) {
    const int action = left.back();
    left.pop_back();
    if (reached[static_cast<std::size_t>(action)]) continue;
    reached[static_cast<std::size_t>(action)] = true;
    left.insert(left.end(), Row(spec, action).begin(), Row(spec, action).end());
  }
  return reached;
}

// [action]: whether a plan can end after it, at some time.
std::vector<bool> LeadToAnEnd(const sim::TaskSpec& spec) {
  std::vector<bool> ends(spec.actions.size());
  for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = Completes(spec, static_cast<int>(i));
  for (bool more = true; more;) {
    more = false;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const std::vector<int>& row = Row(spec, static_cast<int>(i));
      const bool now = ends[i] || std::any_of(row.begin(), row.end(), [&](int next) {
                         return ends[static_cast<std::size_t>(next)];
                       });
      more = more || now != ends[i];
      ends[i] = now;
    }
  }
  return ends;
}

// From an action that leads to no end, the way round: "stir, pour, stir".
std::string WayRound(const sim::TaskSpec& spec, int action) {
  std::vector<int> way;
  while (std::find(way.begin(), way.end(), action) == way.end()) {
    way.push_back(action);
    action = Row(spec, action).front();
  }
  std::vector<std::string> names;
  for (auto at = std::find(way.begin(), way.end(), action); at != way.end(); ++at)
    names.push_back(spec.actions[static_cast<std::size_t>(*at)].name);
  names.push_back(names.front());
  if (names.size() > 6) names.erase(names.begin() + 4, names.end() - 1), names[3] = "...";
  return base::Joined(names);
}

// The lengths of complete plans up to the longest that is possible, repeats allowed.
std::vector<int> Lengths(const sim::TaskSpec& spec) {
  std::vector<int> lengths;
  std::vector<bool> now(spec.actions.size(), false);
  for (const int action : spec.successors.back()) now[static_cast<std::size_t>(action)] = true;
  for (int length = 1; length <= planner::kMaxPathLength; ++length) {
    std::vector<bool> next(now.size(), false);
    bool complete = false;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (!now[i]) continue;
      complete = complete || Completes(spec, static_cast<int>(i));
      for (const int after : Row(spec, static_cast<int>(i)))
        next[static_cast<std::size_t>(after)] = true;
    }
    if (complete) lengths.push_back(length);
    now = std::move(next);
  }
  return lengths;
}

// Whether a plan of so many different actions can be found. Gives up, and says so by `true`, where
// too many are to be tried.
bool HasPlanWithoutRepeats(const sim::TaskSpec& spec, int length, planner::Path* path, int* tried) {
  if (++*tried > kMostTried) return true;
  const int last = path->empty() ? spec.null_action() : path->back();
  if (static_cast<int>(path->size()) == length) return Completes(spec, last);
  for (const int next : Row(spec, last)) {
    if (std::find(path->begin(), path->end(), next) != path->end()) continue;
    path->push_back(static_cast<std::uint8_t>(next));
    if (HasPlanWithoutRepeats(spec, length, path, tried)) return true;
    path->pop_back();
  }
  return false;
}

std::string Few(const std::vector<int>& lengths) {
  std::vector<std::string> texts;
  for (const int length : lengths) {
    if (texts.size() == 6) {
      texts.push_back("...");
      break;
    }
    texts.push_back(std::to_string(length));
  }
  return base::Joined(texts);
}

PlanDefect LengthDefect(int length, const std::string& why) {
  return {-1, "no plan has " + std::to_string(length) + " actions" + why};
}

std::optional<PlanDefect> DefectOfLength(const sim::TaskSpec& spec, int length,
                                         const std::vector<int>& lengths) {
  if (std::find(lengths.begin(), lengths.end(), length) == lengths.end())
    return LengthDefect(length, ": by 'first' and 'follows' they have " + Few(lengths) +
                                    "; give one of these, or change the rules");
  if (spec.repeats_allowed) return std::nullopt;
  if (length > static_cast<int>(spec.actions.size()))
    return LengthDefect(length, " without repeating one of " + std::to_string(spec.actions.size()) +
                                    ": shorten it, or say 'repeats_allowed: true'");
  planner::Path path;
  int tried = 0;
  if (HasPlanWithoutRepeats(spec, length, &path, &tried)) return std::nullopt;
  return LengthDefect(length, " without a repeat: shorten it, or say 'repeats_allowed: true'");
}

}  // namespace

std::optional<PlanDefect> FindPlanDefect(const sim::TaskSpec& spec,
                                         const std::vector<int>& lengths) {
  const std::vector<bool> reached = Reached(spec), ends = LeadToAnEnd(spec);
  for (const sim::ActionSpec& action : spec.actions) {
    const auto i = static_cast<std::size_t>(action.index);
    if (!reached[i] || ends[i]) continue;
    return PlanDefect{action.index,
                      "after '" + action.name + "' no plan can be complete, it goes round (" +
                          WayRound(spec, action.index) +
                          "): let nothing, or only what may come first, follow one of them"};
  }
  const std::vector<int> possible = Lengths(spec);
  for (const int length : lengths) {
    if (auto defect = DefectOfLength(spec, length, possible)) return defect;
  }
  return std::nullopt;
}

std::vector<int> Completing(const sim::TaskSpec& spec) {
  const std::vector<bool> reached = Reached(spec);
  std::vector<int> completing;
  for (const sim::ActionSpec& action : spec.actions) {
    if (reached[static_cast<std::size_t>(action.index)] && Completes(spec, action.index))
      completing.push_back(action.index);
  }
  return completing;
}

std::vector<int> NeverReached(const sim::TaskSpec& spec) {
  const std::vector<bool> reached = Reached(spec);
  std::vector<int> never;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    if (!reached[i]) never.push_back(static_cast<int>(i));
  }
  return never;
}

}  // namespace prospect::tasks

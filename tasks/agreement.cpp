#include "tasks/agreement.h"

#include <algorithm>
#include <cmath>

#include "base/number_format.h"
#include "base/text.h"

namespace prospect::tasks {
namespace {

constexpr double kSameSeconds = 1e-5;  // as a share
constexpr std::size_t kMostTold = 3, kMostNames = 6;

std::vector<std::string> ObjectsOf(const sim::TaskSpec& spec) {
  std::vector<std::string> objects;
  for (const sim::ActionSpec& action : spec.actions) {
    if (std::find(objects.begin(), objects.end(), action.object) == objects.end())
      objects.push_back(action.object);
  }
  return objects;
}

std::string Short(const std::string& text) {
  constexpr std::size_t kMost = 64;
  return text.size() > kMost ? text.substr(0, kMost) + "..." : text;
}

std::string Names(const sim::TaskSpec& spec, const std::vector<int>& actions) {
  std::vector<std::string> names;
  for (const int action : actions) {
    if (names.size() == kMostNames) {
      names.push_back("...");
      break;
    }
    names.push_back(Short(spec.actions.at(static_cast<std::size_t>(action)).name));
  }
  return names.empty() ? "none" : base::Joined(names);
}

std::string Seconds(double seconds) { return base::Number("%g", seconds); }

class Comparison {
 public:
  Comparison(const TaskFile& file, const sim::TaskSpec& said) : file_(file), said_(said) {}

  std::vector<Difference> Made() {
    Compare("name", file_.spec.name, said_.name);
    Compare("picture.width", file_.spec.image_width, said_.image_width);
    Compare("picture.height", file_.spec.image_height, said_.image_height);
    if (SameActions()) CompareRules();
    Compare("repeats_allowed", Flag(file_.spec.repeats_allowed), Flag(said_.repeats_allowed));
    if (!file_.simulator || !file_.simulator->scene_file) CompareTimes();
    return std::move(differences_);
  }

 private:
  static std::string Flag(bool flag) { return flag ? "true" : "false"; }

  void Note(const std::string& field, const std::string& file, const std::string& said) {
    differences_.push_back({field, file, said});
  }
  void Compare(const std::string& field, const std::string& file, const std::string& said) {
    if (file != said) Note(field, Short(file), Short(said));
  }
  void Compare(const std::string& field, int file, int said) {
    Compare(field, std::to_string(file), std::to_string(said));
  }

  bool SameActions() {
    const auto &mine = file_.spec.actions, &others = said_.actions;
    const std::size_t before = differences_.size();
    Compare("the number of actions", static_cast<int>(mine.size()),
            static_cast<int>(others.size()));
    for (std::size_t i = 0; i < std::min(mine.size(), others.size()); ++i) {
      const std::string action = "action " + std::to_string(i);
      Compare(action, mine[i].name, others[i].name);
      Compare(action + "'s kind", mine[i].kind, others[i].kind);
      Compare(action + "'s object", mine[i].object, others[i].object);
    }
    return differences_.size() == before;
  }

  // Without repeats it says nothing that an action may follow itself.
  std::vector<int> Row(const sim::TaskSpec& spec, std::size_t action) const {
    std::vector<int> row = spec.successors.at(action);
    std::sort(row.begin(), row.end());
    if (!file_.spec.repeats_allowed && !said_.repeats_allowed)
      std::erase(row, static_cast<int>(action));
    return row;
  }

  void CompareRules() {
    for (std::size_t i = 0; i <= said_.actions.size(); ++i) {
      const std::vector<int> mine = Row(file_.spec, i), others = Row(said_, i);
      if (mine == others) continue;
      const bool first = i == said_.actions.size();
      Note(first ? "what may come first" : "what may follow " + Short(said_.actions[i].name),
           Names(file_.spec, mine), Names(said_, others));
    }
  }

  void CompareTimes() {
    CompareSeconds("tick_seconds", file_.spec.tick_seconds, said_.tick_seconds);
    const auto& lengths = file_.plan_lengths;
    const auto length = std::find(lengths.begin(), lengths.end(), said_.plan_length);
    if (length == lengths.end()) {
      std::vector<std::string> known;
      for (const int one : lengths) known.push_back(std::to_string(one));
      return Note("plan_length", base::Joined(known, " or "), std::to_string(said_.plan_length));
    }
    CompareSeconds("action_time_limit",
                   file_.time_limits.at(static_cast<std::size_t>(length - lengths.begin())),
                   said_.action_time_limit);
  }

  void CompareSeconds(const std::string& field, double file, double said) {
    if (std::abs(file - said) > kSameSeconds * file) Note(field, Seconds(file), Seconds(said));
  }

  const TaskFile& file_;
  const sim::TaskSpec& said_;
  std::vector<Difference> differences_;
};

}  // namespace

TaskFile ForScene(const TaskFile& file, const sim::TaskSpec& said) {
  const bool other = file.simulator && file.simulator->scene_file && said.name == file.spec.name &&
                     ObjectsOf(said) != ObjectsOf(file.spec);
  return other ? ReadTaskFile(file.path, ObjectsOf(said)) : file;
}

std::vector<Difference> DifferencesOf(const TaskFile& file, const sim::TaskSpec& said) {
  return Comparison(file, said).Made();
}

std::string InWords(const std::vector<Difference>& differences, const TaskFile& file) {
  std::vector<std::string> told;
  for (const Difference& one : differences) {
    if (told.size() == kMostTold) {
      told.push_back(std::to_string(differences.size() - kMostTold) + " more");
      break;
    }
    const bool first = told.empty();
    told.push_back(one.field + " is " + one.file + (first ? " in " + file.path : " there") + ", " +
                   one.said + (first ? " on the bus" : " here"));
  }
  return base::Joined(told, "; ");
}

std::vector<std::string> UnknownCauses(const TaskFile& file, const sim::TaskSpec& said) {
  std::vector<std::string> unknown;
  for (const sim::CauseSpec& cause : said.causes) {
    const auto same = [&](const sim::CauseSpec& known) { return known.name == cause.name; };
    if (std::none_of(file.spec.causes.begin(), file.spec.causes.end(), same))
      unknown.push_back(Short(cause.name));
  }
  return unknown;
}

}  // namespace prospect::tasks

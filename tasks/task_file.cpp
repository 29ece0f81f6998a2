#include "tasks/task_file.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "planner/path.h"
#include "planner/tower.h"
#include "tasks/action_table.h"
#include "tasks/goal_forms.h"
#include "tasks/names.h"
#include "tasks/plan_check.h"
#include "tasks/section.h"
#include "tasks/training_text.h"

namespace prospect::tasks {
namespace {

constexpr std::size_t kLargestFile = 1 << 18;
constexpr int kLeastSide = 32, kMostSide = 256, kSideStep = 16;
constexpr double kLongestTick = 10, kLongestAction = 3600;
constexpr int kMostCauses = 255;
const std::vector<std::string> kKeys = {"name",
                                        "default",
                                        "picture",
                                        "actions",
                                        "first",
                                        "follows",
                                        "retry",
                                        "plan_length",
                                        "repeats_allowed",
                                        "tick_seconds",
                                        "action_time_limit",
                                        "goals",
                                        "causes",
                                        "only_predicted",
                                        "simulator",
                                        "training"};

class Reader {
 public:
  Reader(const std::string& path, const YAML::Node& node)
      : file_(path), top_(path, node, "", kKeys) {}

  TaskFile Read(const std::vector<std::string>& objects) {
    task_.path = file_;
    ReadName();
    ReadPicture();
    const ActionTable table(file_, top_.Need("actions", "list them, or give kinds and objects"),
                            objects);
    task_.spec.actions = table.actions();
    task_.spec.repeats_allowed = top_.Flag("repeats_allowed", false);
    ReadSuccessors(table);
    ReadLengths();
    RequirePlans();
    if (top_.Has("goals"))
      task_.goals = ReadGoals(file_, top_.Maybe("goals"), table, task_.spec.successors);
    ReadCauses();
    task_.only_predicted = top_.Flag("only_predicted", false);
    ReadSimulator();
    ReadTraining();
    return std::move(task_);
  }

 private:
  void ReadName() {
    task_.spec.name = top_.Text("name", "a name such as my_rover");
    const std::string defect = TaskNameDefect(task_.spec.name);
    if (!defect.empty()) top_.Fail("name", "the name " + Quoted(task_.spec.name) + " " + defect);
    task_.usual = top_.Flag("default", false);
  }

  void ReadPicture() {
    const Section picture(file_, top_.Need("picture", "give '{width: 64, height: 64}'"), "picture",
                          {"width", "height"});
    task_.spec.image_width = SideOf(picture, "width");
    task_.spec.image_height = SideOf(picture, "height");
  }

  static int SideOf(const Section& picture, const std::string& key) {
    const std::string what =
        "a multiple of 16 from 32 to 256 (pixels); the robot scales pictures "
        "of another size";
    const int side = picture.Whole(key, kLeastSide, kMostSide, what);
    if (side % kSideStep != 0)
      picture.Fail(key, picture.Name(key) + " is " + std::to_string(side) + ": give " + what);
    return side;
  }

  void ReadSuccessors(const ActionTable& table) {
    auto& rows = task_.spec.successors;
    rows.resize(task_.spec.actions.size() + 1);
    lines_.assign(task_.spec.actions.size(), top_.Maybe("actions"));
    rows.back() =
        table.AllMeant(top_.Need("first", "name the actions that may come first, or 'any'"));
    if (rows.back().empty()) top_.Fail("first", "first names no action: name one, or 'any'");
    const YAML::Node follows =
        top_.Need("follows", "say what may follow what, such as 'any: any_other'");
    if (!follows.IsMap()) FailAt(file_, follows, "follows must be a map, such as 'any: any_other'");
    for (const auto& entry : follows) {
      if (!entry.first.IsScalar()) FailAt(file_, entry.first, "name an action or a kind");
      for (const int action : table.Meant(entry.first.Scalar(), entry.first))
        Follow(table, action, entry);
    }
    if (top_.Has("retry")) ReadRetry(table);
  }

  template <typename Entry>
  void Follow(const ActionTable& table, int action, const Entry& entry) {
    if (!entry.second.IsSequence() && !entry.second.IsScalar())
      FailAt(file_, entry.first,
             "say what may follow " + Quoted(entry.first.Scalar()) +
                 ": an action, a kind, any, any_other, a list of such or []");
    lines_[static_cast<std::size_t>(action)] = entry.first;
    AddRow(action, table.AllMeant(entry.second, action));
  }

  void ReadRetry(const ActionTable& table) {
    const std::vector<int> first = task_.spec.successors.back();
    for (const int action : table.AllMeant(top_.Maybe("retry"))) {
      if (task_.spec.successors[static_cast<std::size_t>(action)].empty())
        top_.Fail("retry", "after '" + task_.spec.actions[static_cast<std::size_t>(action)].name +
                               "' a plan is complete, so nothing is begun anew: leave it out");
      AddRow(action, first);
    }
  }

  void AddRow(int action, const std::vector<int>& more) {
    std::vector<int>& row = task_.spec.successors[static_cast<std::size_t>(action)];
    std::set<int> all(row.begin(), row.end());
    all.insert(more.begin(), more.end());
    row.assign(all.begin(), all.end());
  }

  void ReadLengths() {
    const YAML::Node lengths = top_.Need("plan_length", "give the number of actions of a plan");
    const std::string what = "a whole number from 1 to " + std::to_string(planner::kMaxPathLength);
    for (const YAML::Node& one : ListOf(file_, lengths, what)) {
      int length = 0;
      if (!YAML::convert<int>::decode(one, length) || length < 1 ||
          length > planner::kMaxPathLength)
        FailAt(file_, one, "plan_length is " + Quoted(one.Scalar()) + ": give " + what);
      task_.plan_lengths.push_back(length);
    }
    task_.spec.tick_seconds =
        PositiveNumber(file_, top_.Need("tick_seconds", "give the seconds between two pictures"),
                       "tick_seconds", kLongestTick);
    for (const YAML::Node& one :
         ListOf(file_, top_.Need("action_time_limit", "give the seconds an action may take"),
                "a number of seconds"))
      task_.time_limits.push_back(PositiveNumber(file_, one, "action_time_limit", kLongestAction));
    if (task_.time_limits.size() == 1)
      task_.time_limits.resize(task_.plan_lengths.size(), task_.time_limits.front());
    if (task_.plan_lengths.empty() || task_.time_limits.size() != task_.plan_lengths.size())
      top_.Fail("action_time_limit",
                "action_time_limit must be one number, or one for each plan_length");
    task_.spec.plan_length = task_.plan_lengths.front();
    task_.spec.action_time_limit = task_.time_limits.front();
  }

  void RequirePlans() {
    const auto defect = FindPlanDefect(task_.spec, task_.plan_lengths);
    if (!defect) return;
    if (defect->action < 0) top_.Fail("plan_length", defect->what);
    FailAt(file_, lines_[static_cast<std::size_t>(defect->action)], defect->what);
  }

  void ReadCauses() {
    if (!top_.Has("causes")) return;
    const YAML::Node causes = top_.Maybe("causes");
    if (!causes.IsMap()) FailAt(file_, causes, "causes must be a map, such as 'time: it was late'");
    if (causes.size() > kMostCauses)
      FailAt(file_, causes,
             "there are more than " + std::to_string(kMostCauses) + " causes: name fewer");
    std::set<std::string> seen;
    for (const auto& entry : causes) ReadCause(entry.first, entry.second, &seen);
  }

  void ReadCause(const YAML::Node& key, const YAML::Node& value, std::set<std::string>* seen) {
    const std::string name = key.IsScalar() ? key.Scalar() : "";
    const std::string words = value.IsScalar() ? value.Scalar() : "";
    const std::string defect = PhraseDefect(name), wrong = SentenceDefect(words);
    if (!defect.empty()) FailAt(file_, key, "the cause " + Quoted(name) + " " + defect);
    if (!wrong.empty())
      FailAt(file_, key, "what people are told of the cause " + Quoted(name) + " " + wrong);
    if (!seen->insert(name).second)
      FailAt(file_, key, "the cause " + Quoted(name) + " is there twice: leave one out");
    task_.spec.causes.push_back({name, words});
  }

  void ReadSimulator() {
    if (!top_.Has("simulator")) return;
    const Section section(file_, top_.Maybe("simulator"), "simulator",
                          {"scene", "scene_file", "shifts"});
    Simulator simulator;
    simulator.scene_file = section.Flag("scene_file", false);
    simulator.shifts = section.Flag("shifts", false);
    if (section.Has("scene")) {
      const std::vector<std::string> known{"objects", "legs", "tower"};
      const Section scene(file_, section.Maybe("scene"), "simulator.scene", known);
      for (const std::string& key : known) {
        if (scene.Has(key))
          simulator.scene[key] = scene.Whole(key, 1, 255, "a number from 1 to 255");
      }
    }
    task_.simulator = simulator;
  }

  void ReadTraining() {
    if (!top_.Has("training")) return;
    const YAML::Node training = top_.Maybe("training");
    task_.training_line = training.Mark().line + 1;
    if (training.IsMap()) {
      task_.training = TrainingText(file_, training);
      return;
    }
    task_.training_of = top_.Text("training", "settings, or the name of a task whose are taken");
    const std::string defect = TaskNameDefect(task_.training_of);
    if (!defect.empty())
      top_.Fail("training", "the task " + Quoted(task_.training_of) + " " + defect);
  }

  std::string file_;
  Section top_;
  TaskFile task_;
  std::vector<YAML::Node> lines_;  // by action: where its rule stands
};

std::string TextOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (in) text << in.rdbuf();
  if (!in || in.bad())
    throw TaskFileError("no task file at " + Quoted(path) + ": name one that can be read");
  return text.str();
}

}  // namespace

planner::TaskRules TaskFile::Rules() const {
  planner::TaskRules rules;
  rules.num_actions = static_cast<int>(spec.actions.size());
  rules.plan_length = spec.plan_length;
  rules.successors = spec.successors;
  rules.repeats_allowed = spec.repeats_allowed;
  rules.tower = planner::OneTower(Words(), rules);
  return rules;
}

std::vector<planner::ActionWords> TaskFile::Words() const {
  std::vector<planner::ActionWords> words;
  for (const sim::ActionSpec& action : spec.actions) words.push_back({action.kind, action.object});
  return words;
}

TaskFile ReadTaskFile(const std::string& path, const std::vector<std::string>& objects) {
  return ParseTaskFile(TextOf(path), path, objects);
}

TaskFile ParseTaskFile(const std::string& text, const std::string& path,
                       const std::vector<std::string>& objects) {
  if (text.size() > kLargestFile)
    throw TaskFileError(path + ":1: has " + std::to_string(text.size()) +
                        " bytes: a task file has at most " + std::to_string(kLargestFile));
  try {
    return Reader(path, YAML::Load(text)).Read(objects);
  } catch (const YAML::Exception& error) {
    const int line = error.mark.is_null() ? 1 : error.mark.line + 1;
    throw TaskFileError(path + ":" + std::to_string(line) + ": is no YAML, " + error.msg +
                        ": compare docs/task-files.md");
  }
}

}  // namespace prospect::tasks

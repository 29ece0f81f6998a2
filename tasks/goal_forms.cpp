#include "tasks/goal_forms.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "tasks/names.h"
#include "tasks/section.h"

namespace prospect::tasks {
namespace {

constexpr std::size_t kMostFacts = 4096;
constexpr char kThen[] = " then ";

using Values = std::map<std::string, std::string>;  // of what stands for an object

std::vector<std::string> Parted(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else if (c != ' ') {
      parts.back() += c;
    }
  }
  return parts;
}

// "lift(A)": the actions of a kind about what A stands for.
struct ActionForm {
  YAML::Node node;
  std::string word;                    // an action, a kind, any; empty where there are arguments
  std::string kind;                    // else
  std::vector<std::string> arguments;  // objects, or what stands for them
};

struct StepForm {
  std::optional<ActionForm> previous;
  ActionForm action;
};

class FormReader {
 public:
  FormReader(const std::string& file, const ActionTable& table,
             const std::vector<std::vector<int>>& successors)
      : file_(file), table_(table), successors_(successors) {}

  // All facts of one form: "on(A,B)" and what stands below it.
  void Read(const YAML::Node& key, const YAML::Node& value,
            std::vector<planner::GoalFact>* facts) const {
    const std::string& atom = key.Scalar();
    const std::string defect = ActionNameDefect(atom);
    if (!defect.empty() || atom.find('(') == std::string::npos)
      FailAt(file_, key,
             "the goal " + Quoted(atom) +
                 " is not of the form on(A,B), where A and B stand for "
                 "objects: write it so");
    const NameParts parts = PartsOf(atom);
    const std::vector<std::string> variables = Parted(parts.object);
    RequireSound(key, variables);
    const Section section(file_, value, "goals." + atom, {"by", "undone_by"});
    const auto by = StepsOf(section.Need("by", "say which action brings it about"), variables);
    std::vector<StepForm> undone;
    if (section.Has("undone_by")) undone = StepsOf(section.Maybe("undone_by"), variables);
    const std::size_t before = facts->size();
    ForAllValues(variables, [&](const Values& values) {
      planner::GoalFact fact{parts.kind, {}, Ground(by, values), Ground(undone, values)};
      if (fact.brought_by.empty()) return;
      for (const auto& step : fact.brought_by) std::erase(fact.undone_by, step);
      for (const std::string& variable : variables) fact.arguments.push_back(values.at(variable));
      facts->push_back(std::move(fact));
    });
    if (facts->size() == before)
      FailAt(file_, key,
             "no plan can bring " + Quoted(atom) +
                 " about: 'follows' must allow a step of its "
                 "'by' for some object");
  }

 private:
  void RequireSound(const YAML::Node& key, const std::vector<std::string>& variables) const {
    const std::set<std::string> different(variables.begin(), variables.end());
    if (variables.size() > 2 || different.size() != variables.size())
      FailAt(file_, key,
             "the goal " + Quoted(key.Scalar()) +
                 " must be about one or two objects, "
                 "each under a letter of its own: write it as on(A,B)");
    std::size_t facts = 1;
    for (std::size_t i = 0; i < variables.size(); ++i) facts *= table_.objects().size();
    if (facts > kMostFacts)
      FailAt(file_, key,
             "the goal " + Quoted(key.Scalar()) + " may be " + std::to_string(facts) +
                 " facts: leave it out, or let it be about one object");
  }

  std::vector<StepForm> StepsOf(const YAML::Node& node,
                                const std::vector<std::string>& variables) const {
    std::vector<StepForm> steps;
    for (const YAML::Node& one : ListOf(file_, node, "an action, or 'ACTION then ACTION'")) {
      const std::string& text = one.Scalar();
      const std::size_t then = text.find(kThen);
      StepForm step;
      if (then != std::string::npos) {
        step.previous = FormOf(one, text.substr(0, then), variables);
        step.action = FormOf(one, text.substr(then + sizeof(kThen) - 1), variables);
      } else {
        step.action = FormOf(one, text, variables);
      }
      steps.push_back(std::move(step));
    }
    return steps;
  }

  ActionForm FormOf(const YAML::Node& node, const std::string& text,
                    const std::vector<std::string>& variables) const {
    const NameParts parts = PartsOf(text);
    ActionForm form{node, text, "", {}};
    for (const std::string& argument : Parted(parts.object)) {
      if (std::find(variables.begin(), variables.end(), argument) != variables.end())
        form.kind = parts.kind;
    }
    if (form.kind.empty()) {
      table_.Meant(text, node);
      return form;
    }
    form.word.clear();
    form.arguments = Parted(parts.object);
    table_.Meant(form.kind, node);
    return form;
  }

  std::vector<int> Actions(const ActionForm& form, const Values& values) const {
    if (!form.word.empty()) return table_.Meant(form.word, form.node);
    std::string object;
    for (const std::string& argument : form.arguments) {
      const auto value = values.find(argument);
      object += (object.empty() ? "" : ",") + (value == values.end() ? argument : value->second);
    }
    std::vector<int> actions;
    for (const sim::ActionSpec& action : table_.actions()) {
      if (action.kind == form.kind && action.object == object) actions.push_back(action.index);
    }
    return actions;
  }

  // Those that the table allows.
  std::vector<planner::GoalStep> Ground(const std::vector<StepForm>& forms,
                                        const Values& values) const {
    std::vector<planner::GoalStep> steps;
    for (const StepForm& form : forms) {
      const std::vector<int> actions = Actions(form.action, values);
      const std::vector<int> before =
          form.previous ? Actions(*form.previous, values) : std::vector<int>{-1};
      for (const int previous : before) {
        for (const int action : actions) {
          if (previous < 0 || Follows(previous, action)) steps.push_back({previous, action});
        }
      }
    }
    return steps;
  }

  bool Follows(int previous, int action) const {
    const std::vector<int>& row = successors_.at(static_cast<std::size_t>(previous));
    return std::find(row.begin(), row.end(), action) != row.end();
  }

  template <typename Use>
  void ForAllValues(const std::vector<std::string>& variables, const Use& use,
                    Values values = {}) const {
    if (values.size() == variables.size()) return use(values);
    for (const std::string& object : table_.objects()) {
      values[variables[values.size()]] = object;
      ForAllValues(variables, use, values);
      values.erase(std::prev(values.end()));
    }
  }

  const std::string& file_;
  const ActionTable& table_;
  const std::vector<std::vector<int>>& successors_;
};

}  // namespace

std::vector<planner::GoalFact> ReadGoals(const std::string& file, const YAML::Node& node,
                                         const ActionTable& table,
                                         const std::vector<std::vector<int>>& successors) {
  if (!node.IsMap())
    FailAt(file, node, "goals must be a map, such as 'visited(A): {by: go_to(A)}'");
  const FormReader reader(file, table, successors);
  std::vector<planner::GoalFact> facts;
  for (const auto& entry : node) {
    if (!entry.first.IsScalar()) FailAt(file, entry.first, "a goal is named as on(A,B)");
    reader.Read(entry.first, entry.second, &facts);
  }
  return facts;
}

}  // namespace prospect::tasks

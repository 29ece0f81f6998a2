#include "tasks/learned.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "base/number_format.h"
#include "base/text.h"
#include "tasks/names.h"
#include "tasks/section.h"
#include "tasks/task_file.h"

namespace prospect::tasks {
namespace {

// As YAML wants a scalar: in quotation marks where it must be.
std::string Scalar(const std::string& text) {
  YAML::Emitter out;
  out << YAML::Flow << YAML::BeginSeq << text << YAML::EndSeq;  // in a list, a comma matters, too
  const std::string list = out.c_str();
  return list.substr(1, list.size() - 2);
}

void Require(const std::string& what, const std::string& text, const std::string& defect) {
  if (defect.empty()) return;
  throw TaskFileError("TASK on the bus: " + what + " " + Quoted(text) + " " + defect +
                      "; change it at the robot");
}

void RequireNames(const sim::TaskSpec& said) {
  Require("the name", said.name, TaskNameDefect(said.name));
  for (const sim::ActionSpec& action : said.actions) {
    Require("the action", action.name, ActionNameDefect(action.name));
    Require("the kind", action.kind, PhraseDefect(action.kind));
    if (!action.object.empty()) Require("the object", action.object, PhraseDefect(action.object));
  }
  for (const sim::CauseSpec& cause : said.causes) {
    Require("the cause", cause.name, PhraseDefect(cause.name));
    Require("words", cause.words, SentenceDefect(cause.words));
  }
}

std::string RowOf(const sim::ActionSpec& action) {
  const NameParts parts = PartsOf(action.name);
  if (parts.kind == action.kind && parts.object == action.object)
    return "  - " + Scalar(action.name) + "\n";
  std::string row = "  - {name: " + Scalar(action.name) + ", kind: " + Scalar(action.kind);
  if (action.object != parts.object) row += ", object: " + Scalar(action.object);
  return row + "}\n";
}

// The shortest words that mean a row: any, any_other, or the names.
std::string WordsOf(const sim::TaskSpec& said, std::vector<int> row, int after) {
  std::sort(row.begin(), row.end());
  const int count = static_cast<int>(said.actions.size());
  if (static_cast<int>(row.size()) == count) return "any";
  const bool itself = std::find(row.begin(), row.end(), after) != row.end();
  if (after < count && !itself && static_cast<int>(row.size()) == count - 1) return "any_other";
  std::vector<std::string> names;
  for (const int action : row)
    names.push_back(Scalar(said.actions.at(static_cast<std::size_t>(action)).name));
  return "[" + base::Joined(names) + "]";
}

std::string RulesOf(const sim::TaskSpec& said) {
  const int count = static_cast<int>(said.actions.size());
  std::string text = "first: " + WordsOf(said, said.successors.back(), count) + "\nfollows:\n";
  for (int i = 0; i < count; ++i)
    text += "  " + Scalar(said.actions[static_cast<std::size_t>(i)].name) + ": " +
            WordsOf(said, said.successors.at(static_cast<std::size_t>(i)), i) + "\n";
  return text;
}

}  // namespace

std::string LearnedFile(const sim::TaskSpec& said) {
  RequireNames(said);
  std::string text =
      "# What the robot said of itself on the bus. What each line means, and what "
      "else may stand here: docs/task-files.md.\n\nname: " +
      said.name + "\npicture: {width: " + std::to_string(said.image_width) +
      ", height: " + std::to_string(said.image_height) + "}\n\nactions:\n";
  for (const sim::ActionSpec& action : said.actions) text += RowOf(action);
  text += RulesOf(said) + "repeats_allowed: " + (said.repeats_allowed ? "true" : "false") +
          "\nplan_length: " + std::to_string(said.plan_length) +
          "\ntick_seconds: " + base::Number("%.7g", said.tick_seconds) +
          "\naction_time_limit: " + base::Number("%.7g", said.action_time_limit) + "\n";
  text +=
      "\n# What may be asked for with --goal; a robot does not say it. A and B stand for any "
      "objects.\n# goals:\n#   done(A): {by: " +
      said.actions.front().kind + "(A)}\n";
  if (!said.causes.empty()) text += "\ncauses:\n";
  for (const sim::CauseSpec& cause : said.causes)
    text += "  " + Scalar(cause.name) + ": " + Scalar(cause.words) + "\n";
  ParseTaskFile(text, "TASK on the bus");  // whatever else is wrong with it is told
  return text;
}

}  // namespace prospect::tasks

#include "cli/options/task.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace prospect::cli {
namespace {

std::string Joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

bool Has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<std::string> TaskNames(Tasks tasks) {
  std::vector<std::string> names{"navigation", "stacking", "suturing", "knot_tying",
                                 "needle_passing"};
  names.resize(tasks == Tasks::kPlanned ? 2 : tasks == Tasks::kSimulated ? 3 : 5);
  return names;
}

CLI::Option* DefineTask(CLI::App& app, std::string& task, Tasks tasks) {
  const auto check = [tasks](const std::string& name) -> std::string {
    const std::string known = Joined(TaskNames(tasks));
    if (Has(TaskNames(tasks), name)) return "";
    if (Has(TaskNames(Tasks::kAll), name))
      return "'" + name + "' is not for this command; it takes " + known;
    return "unknown task '" + name + "'; known: " + known;
  };
  CLI::Option* option = app.add_option("--task", task, "the task")
                            ->type_name("NAME")
                            ->check(CLI::Validator(check, Joined(TaskNames(tasks))));
  if (!task.empty()) option->capture_default_str();
  return option;
}

}  // namespace prospect::cli

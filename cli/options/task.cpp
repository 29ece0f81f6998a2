#include "cli/options/task.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "base/nearest.h"
#include "base/text.h"
#include "cli/installation.h"
#include "tasks/task_folder.h"

namespace prospect::cli {
namespace {

const tasks::TaskFolder& Installed() {
  static const tasks::TaskFolder folder(DataFolder("tasks"));
  return folder;
}

bool Takes(Tasks tasks, const tasks::TaskFile& task) {
  return tasks == Tasks::kAll ||
         (task.simulator && (tasks == Tasks::kSimulated || !task.only_predicted));
}

bool Has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string Unknown(const std::string& name, Tasks tasks) {
  const std::vector<std::string> names = TaskNames(tasks);
  const std::string nearest = base::NearestWord(name, TaskNames(Tasks::kAll));
  return "unknown task '" + name + "'; known: " + base::Joined(names) +
         (!nearest.empty()       ? "; did you mean " + nearest + "?"
          : tasks == Tasks::kAll ? "; a file of your own is named as ./" + name + ".yaml"
                                 : "");
}

std::string Defect(const std::string& name, Tasks tasks) {
  if (tasks == Tasks::kAll && tasks::MeansFile(name)) return "";
  if (Has(TaskNames(tasks), name)) return "";
  Installed().Find(name);  // says so where its file is bad
  if (tasks::MeansFile(name))
    return "'" + name + "' is a task file, but this command needs a built-in simulator; it takes " +
           base::Joined(TaskNames(tasks));
  if (Has(TaskNames(Tasks::kAll), name))
    return "'" + name + "' is not for this command; it takes " + base::Joined(TaskNames(tasks));
  return Unknown(name, tasks);
}

}  // namespace

std::vector<std::string> TaskNames(Tasks tasks) {
  std::vector<std::string> names;
  for (const tasks::TaskFile& task : Installed().All()) {
    if (Takes(tasks, task)) names.push_back(task.spec.name);
  }
  return names;
}

const std::map<std::string, std::string>& BadTasks() { return Installed().Bad(); }

std::string DefaultTask() { return Installed().Usual().spec.name; }

const tasks::TaskFile& TaskOf(const std::string& name_or_file) {
  if (!tasks::MeansFile(name_or_file)) {
    if (const tasks::TaskFile* task = Installed().Find(name_or_file)) return *task;
    throw tasks::TaskFileError(Unknown(name_or_file, Tasks::kAll));
  }
  static std::map<std::string, tasks::TaskFile> files;
  const auto known = files.find(name_or_file);
  if (known != files.end()) return known->second;
  return files.emplace(name_or_file, tasks::ReadTaskFile(name_or_file)).first->second;
}

const tasks::TaskFile* InstalledTask(const std::string& name) { return Installed().Find(name); }

std::string TrainingSettingsOf(const tasks::TaskFile& task) { return Installed().TrainingOf(task); }

CLI::Option* DefineTask(CLI::App& app, std::string& task, Tasks tasks) {
  const bool files = tasks == Tasks::kAll;
  const std::string known = base::Joined(TaskNames(tasks)) + (files ? ", or a task file" : "");
  CLI::Option* option =
      app.add_option("--task", task, "the task")
          ->type_name(files ? "NAME|FILE" : "NAME")
          ->check(CLI::Validator([tasks](const std::string& name) { return Defect(name, tasks); },
                                 known));
  if (!task.empty()) option->capture_default_str();
  return option;
}

}  // namespace prospect::cli

#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/fwd.h"
#include "tasks/task_file.h"

namespace prospect::cli {

/// What --task may name, of the tasks that are installed. Every command knows all names, so that a
/// mistyped one is told from one that this command cannot take.
enum class Tasks {
  kPlanned,    ///< those with a built-in simulator that can be planned: searches and closed loops
  kSimulated,  ///< all with a built-in simulator
  kAll,        ///< all, and files of one's own (docs/task-files.md)
};

/// In the order in which they are told. Throws tasks::TaskFileError, as all of these, where the
/// installation's task files cannot be read.
std::vector<std::string> TaskNames(Tasks tasks);

/// What is wrong with task files of the installation that cannot be used, by name.
const std::map<std::string, std::string>& BadTasks();

/// The one default of --task, for every command: the task whose file says so. Only where a command
/// joins a deployment that is up does that one's task come before it; such commands have an empty
/// string as their default, which means the same.
std::string DefaultTask();

/// The task that --task NAME|FILE means; read once. Throws tasks::TaskFileError: the file is bad,
/// or there is no task of this name.
const tasks::TaskFile& TaskOf(const std::string& name_or_file);

/// The same, where a task was heard of: null where none of this name is installed.
const tasks::TaskFile* InstalledTask(const std::string& name);

/// JSON of the task's training settings (tasks::TaskFolder::TrainingOf).
std::string TrainingSettingsOf(const tasks::TaskFile& task);

/// Adds --task. `task` is shown as the default unless it is empty. With kAll it may be a file;
/// whoever takes it asks TaskOf.
CLI::Option* DefineTask(CLI::App& app, std::string& task, Tasks tasks);

}  // namespace prospect::cli

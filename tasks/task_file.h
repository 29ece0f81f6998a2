#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/exit_error.h"
#include "planner/goal_fact.h"
#include "planner/handovers.h"
#include "planner/task_rules.h"
#include "sim/task.h"

namespace prospect::tasks {

/// A task file that cannot be used. The message is one line: file, line, what is wrong, what helps.
/// Exit code 14.
class TaskFileError : public ExitError {
 public:
  explicit TaskFileError(const std::string& message) : ExitError(kExitDataFile, message) {}
};

/// What commands may ask of a task's built-in world.
struct Simulator {
  std::map<std::string, int> scene;  ///< options of its scenes ("tower"), and their usual values
  bool scene_file = false;           ///< it takes --scene-file
  bool shifts = false;               ///< it takes --factor and --strength
};

/// A file of tasks/, or one of a person's own: all that is known of a task without its robot
/// (docs/task-files.md). A plain value.
struct TaskFile {
  std::string path;  ///< as it was named
  /// Name, actions, what may follow what, picture, times and causes. plan_length and
  /// action_time_limit are the usual ones; world_version, step_seconds and landmarks are a world's
  /// own and stay empty.
  sim::TaskSpec spec;
  bool usual = false;               ///< the task of commands that name none
  std::vector<int> plan_lengths;    ///< of all kinds of scenes; the first is the usual one
  std::vector<double> time_limits;  ///< of an action, simulated seconds; one for each plan length
  std::vector<planner::GoalFact> goals;
  bool only_predicted = false;         ///< its actions are foretold, never planned
  std::optional<Simulator> simulator;  ///< empty: it has no built-in world
  std::string training = "{}";         ///< JSON: what differs from a training's usual settings
  std::string training_of;             ///< or the task whose settings are taken; empty: its own
  int training_line = 0;               ///< where that stands in the file; 0: nowhere

  /// The planner's rules for plans of the usual length; Prepare() has not been called.
  planner::TaskRules Rules() const;
  /// The actions' kinds and objects.
  std::vector<planner::ActionWords> Words() const;
};

/// Reads and checks a file. @param objects in the place of those that the file gives to its kinds;
/// empty: its own. Throws TaskFileError.
TaskFile ReadTaskFile(const std::string& path, const std::vector<std::string>& objects = {});

/// The same of a text. @param path as errors name it
TaskFile ParseTaskFile(const std::string& text, const std::string& path,
                       const std::vector<std::string>& objects = {});

}  // namespace prospect::tasks

#pragma once

#include <string>
#include <vector>

#include "cli/fwd.h"

namespace prospect::cli {

/// What --task may name. Every command knows all names, so that a mistyped one is told from one
/// that this command cannot take.
enum class Tasks {
  kPlanned,    ///< navigation, stacking: searches and closed loops
  kSimulated,  ///< and suturing, which has a simulated scene, too
  kAll,        ///< and knot_tying and needle_passing: recorded gestures
};

/// In the order in which they are told.
std::vector<std::string> TaskNames(Tasks tasks);

/// The one default of --task, for every command: the task that the README begins with, and whose
/// plans are the longest. Only where a command joins a deployment that is up does that one's task
/// come before it; such commands have an empty string as their default, which means the same.
inline constexpr char kDefaultTask[] = "stacking";

/// Adds --task. `task` is shown as the default unless it is empty.
CLI::Option* DefineTask(CLI::App& app, std::string& task, Tasks tasks);

}  // namespace prospect::cli

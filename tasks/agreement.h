#pragma once

#include <string>
#include <vector>

#include "sim/task.h"
#include "tasks/task_file.h"

namespace prospect::tasks {

/// Something that a task file and a robot (or the simulator) say differently.
struct Difference {
  std::string field;  ///< "plan_length"
  std::string file;   ///< the file's value, in words
  std::string said;   ///< the robot's
};

/// What is known of a task whose table was heard: `file`, with the objects of the scene that is up
/// where its world takes scenes of one's own.
TaskFile ForScene(const TaskFile& file, const sim::TaskSpec& said);

/// Where `file` and what was said do not agree, the weightiest first; causes left out, which decide
/// nothing. A task's own world with a scene of one's own may have other times.
std::vector<Difference> DifferencesOf(const TaskFile& file, const sim::TaskSpec& said);

/// In one line: "plan_length is 4 in rover.yaml, 5 on the bus"; of many the first three.
std::string InWords(const std::vector<Difference>& differences, const TaskFile& file);

/// Names of causes that were said and of which the file knows no words.
std::vector<std::string> UnknownCauses(const TaskFile& file, const sim::TaskSpec& said);

}  // namespace prospect::tasks

#pragma once

#include <string>

#include "sim/task.h"

namespace prospect::tasks {

/// The text of a first task file for a table that was heard: what the robot says, and as comments
/// what it cannot say. Throws TaskFileError where a name cannot stand in a file: it is to be
/// changed at the robot. What is returned can be read (ParseTaskFile).
std::string LearnedFile(const sim::TaskSpec& said);

}  // namespace prospect::tasks

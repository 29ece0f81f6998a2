#pragma once

#include <string>

#include "sim/task.h"

namespace prospect::report {

/// What a person would want to see of a task's scene, `width` x `height` pixels (1 to 4096): from
/// `camera`, or, where that is empty, from the scene's camera "view" or its only one. Throws
/// std::invalid_argument for a camera that the task has not.
sim::Image PeoplesView(sim::Task& task, const std::string& camera, int width, int height);

}  // namespace prospect::report

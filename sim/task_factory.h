#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/task.h"

namespace prospect::sim {

// Scene parameters a caller may choose.
struct TaskOptions {
  int objects = 4;  // navigation: objects on the site, 4 to 7
  int legs = 3;     // navigation: objects to investigate in a row, 3 to 5, at most `objects`
  double image_noise =
      0.01;  // sigma of the sensor noise as a share of full range; Observe() stays clean
};

// The names MakeTask knows.
std::vector<std::string> TaskNames();

// Makes a task; call Reset before anything else. Throws std::invalid_argument for an unknown name
// (the message lists the known ones) or for options out of range.
std::unique_ptr<Task> MakeTask(const std::string& name, const TaskOptions& options = {});

}  // namespace prospect::sim

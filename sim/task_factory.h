#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/shift.h"
#include "sim/task.h"

namespace prospect::sim {

// Scene parameters a caller may choose.
struct TaskOptions {
  int objects = 4;  // navigation: objects on the site, 4 to 7
  int legs = 3;     // navigation: objects to investigate in a row, 3 to 5, at most `objects`
  int tower = 2;    // stacking: blocks in the tower, 2 to 4
  std::string scene_file =
      {};  // stacking: a file like config/scenes/stacking.yaml; empty: that one
  double execution_noise =
      1.0;  // stacking, suturing: scale of the world's execution noise; 0: none. For measurements
  int surgeon = -1;            // suturing: whose ways the hands have, 0 to 7; -1: drawn by the seed
  int frames_per_second = 15;  // suturing: ticks a simulated second, a divisor of 30
  double image_noise =
      0.01;          // sigma of the sensor noise as a share of full range; Observe() stays clean
  Shift shift = {};  // how pictures differ from those of trials; none
};

// Sets what makes a complete plan `plan_length` actions long: navigation's legs, stacking's tower
// (9, 18 or 27 actions). Throws std::invalid_argument if no scene has such plans.
void SetPlanLength(const std::string& name, int plan_length, TaskOptions* options);

// Makes pictures differ from those of trials by ShiftAmount(factor, strength): sets
// options->shift, or options->image_noise for the factor "noise". Strength 0: leaves them as they
// are. Throws std::invalid_argument for an unknown factor or a strength above kShiftStrengths.
void SetShift(const std::string& factor, int strength, TaskOptions* options);

// The names MakeTask knows.
std::vector<std::string> TaskNames();

// Makes a task; call Reset before anything else. Throws std::invalid_argument for an unknown name
// (the message lists the known ones) or for options out of range.
std::unique_ptr<Task> MakeTask(const std::string& name, const TaskOptions& options = {});

}  // namespace prospect::sim

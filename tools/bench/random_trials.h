// Data sets for benchmarks: made on the fly, of a task's shape, without its world.
#pragma once

#include <cstdint>
#include <string>

#include "model/trial.h"
#include "sim/task.h"

namespace prospect::tools {

// A valid trial of random pictures, landmarks and actions that may follow each other. Every other
// seed fails, after any number of actions: as stacking's data set, whose trials have 6.8 of 9.
model::Trial RandomTrial(const sim::TaskSpec& spec, std::uint64_t seed);

// Writes so many random trials of the training part as a data set. Throws model::DiskError.
void WriteRandomTrials(const sim::TaskSpec& spec, int trials, const std::string& path);

}  // namespace prospect::tools

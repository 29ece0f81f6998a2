#pragma once

#include <cstdint>
#include <optional>

#include "sim/task.h"
#include "tools/ceiling/spread.h"

namespace prospect::tools {

// How often something came true in repetitions that have in common all that may be known.
struct Frequency {
  int runs = 0;
  int came_true = 0;
};

// The repetitions in two halves: what one half foretells is held against the other.
struct Repetitions {
  Frequency first, second;
};

// One moment of a trial between two actions, and what comes of it when the trial goes on from there
// again and again, with other execution noise and, where they were not chosen yet, other actions.
struct Moment {
  Repetitions value;  // trials that succeed
  // The same where the action that really came next was chosen as well, and the two that did; and
  // whether the last of these succeeds. Without runs where the trial had ended; those that end
  // before their last action are not counted.
  Repetitions value_one, done_one, value_two, done_two;
  // How much the pictures at the end of one and of two actions differ; without those of repetitions
  // that `done` does not count.
  PictureErrors pictures_one, pictures_two;
};

// Carries trial `seed` out as the collector does (sim::RandomPlan) until `number` actions have
// ended, and from there on `runs` times in each of the three ways. Empty if the trial has fewer
// actions.
std::optional<Moment> Replay(sim::Task& task, std::uint64_t seed, int number, int runs);

}  // namespace prospect::tools

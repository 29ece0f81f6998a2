#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/task.h"
#include "tools/evaluate/decider.h"

namespace prospect::tools {

// How an episode ended (docs/architecture.md).
enum class Ending {
  kSolved,   // the task's success, and the goal holds
  kRefused,  // no action was ever begun
  kStopped,  // given up after the first action
  kFailed,   // the task's failure, or its success without the goal
};
const char* ToString(Ending ending);  // "solved", "refused", "stopped", "failed"

struct EpisodeRecord {
  Ending ending = Ending::kRefused;
  std::string reason;        // of a failure, refusal or stop
  std::vector<int> actions;  // begun, in order
  double first_score = 0;    // of the first plan: what refusal is decided on
  std::int64_t evaluations = 0;
  std::int64_t rollouts = 0;
  std::vector<double> seconds_per_plan;  // wall clock of each decision
  std::vector<double> scores;            // of the plan that each decision was about
  std::vector<double> surprises;         // of each decision; 0 where no plan was followed
  int begun_anew = 0;                    // times the plan was begun anew
  int carried_on = 0;                    // actions of plans given up as lost
};

// Looks at the world after each action of an episode that goes on, and leaves it as it was.
using AfterAction = std::function<void(sim::Task& task)>;

// Runs one closed loop on scene `seed`: reset, look, decide, act, look again, until the trial is
// over or the decider gives up. Pictures carry sensor noise of standard deviation `image_noise`
// (share of full scale).
// The goal is judged by what the world itself says holds in the end (sim::Task::Facts).
EpisodeRecord RunEpisode(sim::Task& task, Decider& decider, std::uint64_t seed, double image_noise,
                         const Goal& goal = {}, const AfterAction& after = nullptr);

}  // namespace prospect::tools

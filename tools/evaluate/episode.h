#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "agent/listener.h"
#include "agent/record.h"
#include "sim/task.h"
#include "tools/evaluate/decider.h"
#include "tools/evaluate/simulated_world.h"

namespace prospect::tools {

// How an episode ended (docs/architecture.md).
enum class Ending {
  kSolved,   // the task's success, and the goal holds
  kRefused,  // no action was ever begun
  kStopped,  // given up after the first action
  kFailed,   // the task's failure, or its success without the goal
};
const char* ToString(Ending ending);  // "solved", "refused", "stopped", "failed"

// What is measured of an episode.
struct EpisodeRecord {
  Ending ending = Ending::kRefused;
  std::string reason;        // of a refusal or stop; of a failure its cause
  std::vector<int> actions;  // carried out, in order
  double first_score = 0;    // of the first plan: what refusal is decided on
  std::int64_t evaluations = 0;
  std::int64_t rollouts = 0;
  std::vector<double> seconds_per_plan;  // wall clock of each decision
  std::vector<double> scores;            // of the plan that each decision was about
  std::vector<double> surprises;         // of each decision; 0 where nothing was compared
  int begun_anew = 0;                    // times the plan was begun anew
  int carried_on = 0;                    // actions of plans given up as lost
};

/// What an agent's record says of it.
EpisodeRecord MeasuredOf(const agent::EpisodeRecord& record);

/// As a row of a scene's record (report.h).
nlohmann::json ToJson(const EpisodeRecord& record);

using AfterAction = SimulatedWorld::AfterAction;

// Runs one agent::Episode on scene `seed` in this process. Pictures carry sensor noise of standard
// deviation `image_noise` (share of full scale). `goal` is what the decider was made for; the
// agent's own verdict on it goes by what was carried out, and the one measured by what the world
// itself says holds in the end (sim::Task::Facts). `after` is called after each action of an
// episode that goes on. `listener` hears how it goes on; null: nobody does.
EpisodeRecord RunEpisode(sim::Task& task, Decider& decider, std::uint64_t seed, double image_noise,
                         const Goal& goal = {}, const AfterAction& after = nullptr,
                         agent::Listener* listener = nullptr);

// Carries `plan` out on scene `seed` as it is.
EpisodeRecord RunGivenPlan(sim::Task& task, const std::vector<int>& plan, std::uint64_t seed);

}  // namespace prospect::tools

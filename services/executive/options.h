#pragma once

#include <cstdint>
#include <string>

#include "agent/options.h"
#include "cli/options/episode.h"

namespace prospect::services {

/// What a person may ask of one episode on a bus; the defaults are those of the command line.
/// `policy`: "search", "greedy" (the action with the highest Q, then look again), "plan:0,1,2",
/// "collect" or "expert".
struct ExecutiveOptions : agent::EpisodeOptions {
  std::string task;             ///< NAME|FILE; another on the bus is refused; empty: what is there
  std::int64_t seed = 2000000;  ///< scene
  int objects = 0;              ///< on the site; 0: as the simulator stands
  int legs = 0;                 ///< actions in a complete plan; 0: as the simulator stands
  bool reset = true;            ///< false: take the scene as it is, as on a robot
  bool ask = false;   ///< a person says of actions whether they worked, where the robot cannot
  std::string world;  ///< world_version that TASK must have; empty: any
  int leaves = 2;     ///< evaluations a worker may have in flight
  std::int64_t budget_ms = -1;  ///< time for one search; negative: none
  int workers = 1;              ///< planner workers to wait for before the first search
  std::string weights_hash;     ///< 16 hexadecimal digits; empty: whatever the first server holds
  int services_timeout_ms = 15000;  ///< how long to wait for services to appear
  int scene_timeout_ms = 10000;     ///< and then for the scene to stand before the camera
  std::string out;                  ///< folder for results; empty: none are written

  /// Whether the networks decide, so that model servers and workers are needed.
  bool AsksNetworks() const { return policy == "search" || policy == "greedy"; }
};

/// What a person asked for, into what an episode takes; all else stays.
void Take(const cli::EpisodeOptions& asked, ExecutiveOptions* options);

}  // namespace prospect::services

#pragma once

#include <cstdint>
#include <string>

#include "model/novelty_words.h"
#include "model/refusal/promise.h"
#include "model/surprise.h"
#include "planner/search_parameters.h"

namespace prospect::services {

/// What a person may ask of one episode; the defaults are those of the command line.
struct ExecutiveOptions {
  std::string task;                  ///< another on the bus is refused; empty: whatever is there
  std::int64_t seed = 2000000;       ///< scene
  int objects = 0;                   ///< on the site; 0: as the simulator stands
  int legs = 0;                      ///< actions in a complete plan; 0: as the simulator stands
  bool reset = true;                 ///< false: take the scene as it is, as on a robot
  std::string world;                 ///< world_version that TASK must have; empty: any
  std::string policy = "search";     ///< "search", "plan:0,1,2", or "collect"
  std::string goal;                  ///< what planner::ParseGoal reads; empty: the task's own
  planner::SearchParameters search;  ///< rule, constants, samples, depth (0: what remains)
  double refusal_threshold = -1;  ///< plans that score less are refused; negative: the weights' own
  int retries = 1;  ///< times a plan that is lost may be begun anew, where the task allows it
  double surprise = model::kSurprising;  ///< it is lost where a patch differs more than this
  model::Promise promise;  ///< asked for: sets refusal_threshold by the weights' calibration
  double novelty = model::kNoveltyLevel;  ///< pictures with a smaller p-value are refused; 0: none
  int leaves = 2;                         ///< evaluations a worker may have in flight
  std::int64_t budget_ms = -1;            ///< time for one search; negative: none
  int workers = 1;                        ///< planner workers to wait for before the first search
  std::string weights_hash;  ///< 16 hexadecimal digits; empty: whatever the first server holds
  int services_timeout_ms = 15000;  ///< how long to wait for services to appear
  int scene_timeout_ms = 10000;     ///< and then for the scene to stand before the camera
  bool explain_only = false;        ///< searches once, tells why, and carries nothing out
  std::string what_if;  ///< names of actions; what the model expects of them is told, too
  std::string out;      ///< folder for results; empty: none are written
};

}  // namespace prospect::services

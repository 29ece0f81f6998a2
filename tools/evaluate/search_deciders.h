#pragma once

#include <memory>

#include "model/engine.h"
#include "planner/search_parameters.h"
#include "tools/evaluate/decider.h"

namespace prospect::tools {

// How a plan is looked for.
enum class PlanBy {
  kSearch,      // Algorithm 1 with parameters.samples rollouts
  kExhaustive,  // every permitted future
  kGreedy,      // highest Q at each step, never refuses
};

// Plans with the learned networks. `engine` outlives the decider. A plan that is lost is begun anew
// at most `retries` times where the task allows it (planner/attempts.h); greedy never does. It is
// not believed when model::Surprise of what is seen there and of what the plan imagined exceeds
// `surprise`, or model::kAlarming after any earlier action.
std::unique_ptr<Decider> MakeLearned(PlanBy by, model::Engine* engine,
                                     const planner::SearchParameters& parameters,
                                     const Goal& goal = {}, int retries = 0, double surprise = 1);

// Searches with the simulator as its model: perfect imagination, the same number of rollouts, each
// action carried out in so many `runs` (SimulatorModel). A plan is set out on where at least half
// of them succeed.
std::unique_ptr<Decider> MakeSimulatorModel(int runs, const planner::SearchParameters& parameters,
                                            const Goal& goal = {}, int retries = 0);

}  // namespace prospect::tools

#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "agent/options.h"
#include "model/engine.h"
#include "model/novelty.h"
#include "planner/goal.h"
#include "planner/search_parameters.h"
#include "planner/task_rules.h"
#include "sim/task.h"
#include "tools/evaluate/local_mind.h"

namespace prospect::tools {

// A row of the evaluation: whose episodes are run, and how they go.
struct Decider {
  std::unique_ptr<LocalMind> mind;
  agent::EpisodeOptions options;
  bool plans_ahead = true;  // false: it finds one action at a time, and so is always asked again
};

// What is to hold in the end beyond the task's own goal; empty: nothing.
using Goal = std::vector<planner::GoalAtom>;

// Rules of planner/ from a task's table. Throws planner::GoalError when the task cannot bring the
// goal about.
planner::TaskRules RulesOf(const sim::TaskSpec& spec, const Goal& goal = {});

// Never acts.
std::unique_ptr<Decider> MakeNothing();
// Uniform over what is legal in the scene and leads to the goal.
std::unique_ptr<Decider> MakeRandom(const Goal& goal = {});

// Refuses a scene whose first picture is unlike what the networks were trained on: before the first
// action, when the gauge's p-value is below `level` (0: never refuses). `engine` outlives it.
std::unique_ptr<Decider> MakeNoveltyGate(std::unique_ptr<Decider> decider, model::Engine* engine,
                                         const model::NoveltyGauge& gauge, double level);

// Carries the plan that is found from the first picture out as it is, without looking again;
// nothing is planned anew. An episode that goes on after the plan is stopped there.
std::unique_ptr<Decider> MakeOpenLoop(std::unique_ptr<Decider> decider);

}  // namespace prospect::tools

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "planner/goal.h"
#include "planner/path.h"
#include "planner/search_parameters.h"
#include "planner/task_rules.h"
#include "sim/task.h"

namespace prospect::tools {

// What somebody who plans decided to do next.
struct Decision {
  int action = -1;     // -1: gives up; before the first action that is a refusal
  double score = 0;    // of the plan that the action begins, 0..1; 0 where the decider has none
  planner::Path plan;  // the whole of it, the action first; empty where the decider has none
  std::string reason;
  std::int64_t evaluations = 0;
  std::int64_t rollouts = 0;
  // model::Surprise of what is seen and of what the plan that is followed imagined
  double surprise = 0;
  bool anew = false;        // the plan begins anew with this action
  bool carried_on = false;  // the plan is lost; on to where it can begin anew
};

// A way of deciding, run in closed loop: it looks, decides on one action, the world carries that
// out, it looks again. One decider serves many scenes, one after the other. Not thread safe.
class Decider {
 public:
  virtual ~Decider() = default;

  // A new scene. `first` is its first picture as the camera shows it, noise included (RGB, rows
  // from the top).
  virtual void Begin(std::uint64_t scene_seed, const std::vector<std::uint8_t>& first) = 0;

  // The next action after `executed`, from the latest picture. `task` is only for deciders that are
  // allowed to know the world: those that use the simulator as their model, or only legal moves;
  // its state is as it was on return.
  virtual Decision Decide(const planner::Path& executed, const std::vector<std::uint8_t>& latest,
                          sim::Task& task) = 0;
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

}  // namespace prospect::tools

// What a task's goals are made of: facts, and which steps of a plan bring each about. Plain data.
#pragma once

#include <string>
#include <vector>

namespace prospect::planner {

// An action directly after another one.
struct GoalStep {
  int previous = -1;  // -1: after whatever came before, or first
  int action = 0;

  bool operator==(const GoalStep&) const = default;
};

// Something that may hold when a plan is over: on(red,blue).
struct GoalFact {
  std::string predicate;               // "on"
  std::vector<std::string> arguments;  // "red", "blue"
  std::vector<GoalStep> brought_by;    // any of these makes it hold
  std::vector<GoalStep> undone_by;     // after any of these it holds no more

  bool operator==(const GoalFact&) const = default;
};

}  // namespace prospect::planner

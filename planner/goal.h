// What a person wants brought about: read from text, matched with a world's facts, and turned into
// rules for action sequences. Plain data and pure functions, safe from any thread.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "planner/handovers.h"
#include "planner/task_rules.h"

namespace prospect::planner {

// One thing that is to hold when the plan is over: on(red,blue), visited(barrel). An argument "*"
// is left open: on(red,*) is met by red on any block.
struct GoalAtom {
  std::string predicate;
  std::vector<std::string> arguments;

  bool operator==(const GoalAtom& other) const {
    return predicate == other.predicate && arguments == other.arguments;
  }
};

// A well-formed goal that a task cannot bring about; says why, and what there is instead.
class GoalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// All of what `text` asks for: on(A,B), where "*" or "_" leaves a part open, and visited(A,B,...),
// which becomes one atom an object; several are parted by commas, semicolons or spaces. What is
// said twice counts once. Throws std::invalid_argument that names the culprit and what is allowed.
std::vector<GoalAtom> ParseGoal(const std::string& text);

std::string ToString(const GoalAtom& atom);  // "on(red,*)"
// "on(red,blue), visited(barrel)"; what ParseGoal reads.
std::string ToString(const std::vector<GoalAtom>& goal);

// Whether each atom is met by one of the facts that a world says hold ("on(red,blue)").
bool Holds(const std::vector<GoalAtom>& goal, const std::vector<std::string>& facts);

// Sets rules->goal from a goal and the words of the task's table (one entry an action), and
// prepares the rules. visited(X) is brought about by investigate(X). on(X,Y) by handing X over to Y
// (handovers.h); it holds until X is handed over to another. An empty goal asks nothing.
// Throws GoalError when the task does not know a predicate or name, when the atoms contradict one
// another, or when no plan of the task is long enough for all.
void SetGoal(const std::vector<GoalAtom>& goal, const std::vector<ActionWords>& words,
             TaskRules* rules);

}  // namespace prospect::planner

// What a person wants brought about: read from text, matched with a world's facts, and turned into
// rules for action sequences by the facts that a task knows (goal_fact.h). Plain data and pure
// functions, safe from any thread.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "planner/goal_fact.h"
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

// An atom as a search knows it: met while any of `facts` holds, of which several steps of a plan
// set and clear each.
struct GoalTerm {
  struct Fact {
    std::vector<GoalStep> brought_by;
    std::vector<GoalStep> undone_by;

    bool operator==(const Fact&) const = default;
  };
  std::string words;  // "on(*,blue)"
  std::vector<Fact> facts;

  bool operator==(const GoalTerm&) const = default;
};

// All of what `text` asks for: words with names in brackets, where "*" or "_" leaves one open;
// several are parted by commas, semicolons or spaces. What is said twice counts once. Throws
// std::invalid_argument that names the culprit and what is allowed.
std::vector<GoalAtom> ParseGoal(const std::string& text);

std::string ToString(const GoalAtom& atom);  // "on(red,*)"
// "on(red,blue), visited(barrel)"; what ParseGoal reads.
std::string ToString(const std::vector<GoalAtom>& goal);

// Whether each atom is met by one of the facts that a world says hold ("on(red,blue)").
bool Holds(const std::vector<GoalAtom>& goal, const std::vector<std::string>& facts);

// The goal as the task's facts have it: visited(a,b), where visited is about one thing, becomes
// visited(a), visited(b). Throws GoalError where the task knows no such fact or name.
std::vector<GoalAtom> ResolveGoal(const std::vector<GoalAtom>& goal,
                                  const std::vector<GoalFact>& known);

// One term an atom of the goal, resolved. An atom with an open part takes one fact where its facts
// cannot undo one another, else one for each. Throws as ResolveGoal.
std::vector<GoalTerm> TermsOf(const std::vector<GoalAtom>& goal,
                              const std::vector<GoalFact>& known);

// A term in one word, as SEARCH_ROOT carries it to whoever has no task file: "on(red,blue)=12>17"
// where action 17 directly after 12 brings it about, "!12>18" where that undoes it, "=3" where 3
// does so after whatever; facts are parted by "/".
std::string ToString(const GoalTerm& term);
// Throws GoalError for whatever is no term of a task of `num_actions`.
GoalTerm ParseTerm(const std::string& text, int num_actions);

// Sets rules->goal and prepares the rules. No terms ask nothing. Throws GoalError when it is too
// much at once, or when no plan of the task is long enough for all.
void SetGoal(const std::vector<GoalTerm>& terms, TaskRules* rules);

}  // namespace prospect::planner

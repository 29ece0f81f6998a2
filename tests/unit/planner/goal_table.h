// Small tables for tests of goals: stacking in short, where a plan picks a block and puts it on
// another, and visits in any order.
#pragma once

#include <string>
#include <vector>

#include "planner/goal.h"
#include "planner/handovers.h"

namespace prospect::planner {

inline const std::vector<std::string>& GoalNames() {
  static const std::vector<std::string> names = {"red", "green", "blue"};
  return names;
}

// Actions 0 to 2 pick a block, 3 to 5 put it on one, 6 to 8 go home; after putting it down one may
// pick again.
inline std::vector<ActionWords> PickAndPutWords() {
  std::vector<ActionWords> words;
  for (const char* kind : {"pick", "put", "home"}) {
    for (const std::string& name : GoalNames()) words.push_back({kind, name});
  }
  return words;
}

inline TaskRules PickAndPut(int plan_length) {
  TaskRules rules;
  rules.num_actions = 9;
  rules.plan_length = plan_length;
  rules.repeats_allowed = true;
  rules.successors = {{4, 5},       {3, 5},    {3, 4},    {0, 1, 2, 6}, {0, 1, 2, 7},
                      {0, 1, 2, 8}, {0, 1, 2}, {0, 1, 2}, {0, 1, 2},    {0, 1, 2}};
  rules.Prepare();
  return rules;
}

// on(A,B) for all that a table hands over (handovers.h), until A is handed on.
inline std::vector<GoalFact> OnFacts(const std::vector<ActionWords>& words,
                                     const TaskRules& rules) {
  const std::vector<Handover> handovers = FindHandovers(words, rules);
  std::vector<GoalFact> facts;
  for (const Handover& one : handovers) {
    const std::string& upper = words[one.giver].object;
    GoalFact fact{"on", {upper, words[one.taker].object}, {}, {}};
    for (const Handover& other : handovers) {
      if (words[other.giver].object != upper) continue;
      const GoalStep step{static_cast<int>(other.giver), static_cast<int>(other.taker)};
      const bool same = words[other.taker].object == fact.arguments[1];
      (same ? fact.brought_by : fact.undone_by).push_back(step);
    }
    facts.push_back(fact);
  }
  return facts;
}

inline std::vector<GoalFact> PickAndPutFacts() { return OnFacts(PickAndPutWords(), PickAndPut(3)); }

inline std::vector<ActionWords> VisitWords(int count) {
  std::vector<ActionWords> words;
  for (int i = 0; i < count; ++i)
    words.push_back({"investigate", std::string(1, static_cast<char>('a' + i))});
  return words;
}

// visited(a), visited(b), ... by actions 0, 1, ...
inline std::vector<GoalFact> VisitFacts(int count) {
  std::vector<GoalFact> facts;
  for (int i = 0; i < count; ++i)
    facts.push_back({"visited", {std::string(1, static_cast<char>('a' + i))}, {{-1, i}}, {}});
  return facts;
}

}  // namespace prospect::planner

// Which steps of a task's table hand one thing over to another. Pure functions, safe from any
// thread.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/task_rules.h"

namespace prospect::planner {

// A row of a task's action table, in words.
struct ActionWords {
  std::string kind;    // "investigate"
  std::string object;  // "barrel"
};

// From `giver`, the last action with the thing that is moved, to `taker`, the first with where it
// goes: lift(red), then align_over(blue).
struct Handover {
  std::size_t giver, taker;
};

// All of the table: an action about one thing directly after one about another, where the table
// lets it follow and no plan could begin with it. `words`: one entry an action.
std::vector<Handover> FindHandovers(const std::vector<ActionWords>& words, const TaskRules& rules);

}  // namespace prospect::planner

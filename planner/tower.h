// Tasks that build a tower: which blocks a plan may put onto which, so that one tower can stand in
// the end. Derived from the words of the task's table, so that all who know the table agree on it.
// Pure functions, safe from any thread.
#pragma once

#include <vector>

#include "planner/handovers.h"
#include "planner/task_rules.h"

namespace prospect::planner {

// The rules of a task in whose table an action is of the kind "stack": all that a plan hands over
// is to be one tower in the end, of one block more than there are hand-overs, from blocks that lie
// apart at the start. Only what cannot be so is ruled out: a hand-over joins what stands on and
// under the one block with what stands on and under the other and nothing else, so each must join
// two parts that lay apart, and all must be one part in the end. Whether a block can be had from
// under another is for the networks to judge: an arm may well lift both. Empty where the table has
// no such action, or more than kMostBlocks things to hand over.
inline constexpr int kMostBlocks = 6;
TowerRules OneTower(const std::vector<ActionWords>& words, const TaskRules& rules);

// Levels of the tower that a plan of `rules` builds: its hand-overs and the block below. 0 where
// the task builds none. Prepare() must have been called.
int TowerLevels(const TaskRules& rules);

}  // namespace prospect::planner

#pragma once

#include <string>
#include <vector>

#include "sim/task.h"

namespace prospect::sim {

// The stacking task's frozen action table and what may follow what.
//
// Nine kinds, each for every block: index = kind * blocks + block. The first four name the block to
// pick up, the last five the block to stack on. (The paper names eight kinds; backing off is the
// authors' own ninth. Going home is indexed by the block stacked on, as the paper's text says, so
// that what may follow depends on the previous action alone.)
//
// A plan runs through the kinds in their order, with another block from kAlignOver on. After
// kOpen and kBackOff, when the gripper is empty, aligning with any block may follow instead, so
// that a block that was dropped or misplaced can be tried again; and after kHome, so that a higher
// tower can be built.
enum class StackingKind {
  kAlign,      // beside the block, fingers open
  kGrasp,      // fingers about the block
  kClose,      // close the gripper
  kLift,       // up to the home point
  kAlignOver,  // above the block to stack on
  kStack,      // down onto it
  kOpen,       // open the gripper
  kBackOff,    // straight up
  kHome,       // back to the home point
};
inline constexpr int kStackingKinds = 9;

const char* ToString(StackingKind kind);  // "align", ..., "home"

struct StackingAction {
  StackingKind kind;
  int block;
};

int StackingIndex(StackingKind kind, int block, int blocks);
StackingAction StackingActionAt(int index, int blocks);

// Rows of the table for blocks of these names.
std::vector<ActionSpec> StackingActions(const std::vector<std::string>& blocks);

// TaskSpec::successors for so many blocks.
std::vector<std::vector<int>> StackingSuccessors(int blocks);

}  // namespace prospect::sim

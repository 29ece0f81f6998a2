#include "sim/stacking/action_table.h"

namespace prospect::sim {
namespace {

std::vector<int> AllOf(StackingKind kind, int blocks) {
  std::vector<int> row;
  for (int block = 0; block < blocks; ++block) row.push_back(StackingIndex(kind, block, blocks));
  return row;
}

bool MayTryAgain(StackingKind kind) {
  return kind == StackingKind::kOpen || kind == StackingKind::kBackOff;
}

// What a plan goes on with.
std::vector<int> Onward(const StackingAction& from, int blocks) {
  if (from.kind == StackingKind::kHome) return AllOf(StackingKind::kAlign, blocks);
  const auto next = static_cast<StackingKind>(static_cast<int>(from.kind) + 1);
  if (next != StackingKind::kAlignOver) return {StackingIndex(next, from.block, blocks)};
  std::vector<int> others = AllOf(next, blocks);
  others.erase(others.begin() + from.block);
  return others;
}

}  // namespace

const char* ToString(StackingKind kind) {
  static const char* const names[kStackingKinds] = {
      "align", "grasp", "close", "lift", "align_over", "stack", "open", "back_off", "home"};
  return names[static_cast<int>(kind)];
}

int StackingIndex(StackingKind kind, int block, int blocks) {
  return static_cast<int>(kind) * blocks + block;
}

StackingAction StackingActionAt(int index, int blocks) {
  return {static_cast<StackingKind>(index / blocks), index % blocks};
}

std::vector<ActionSpec> StackingActions(const std::vector<std::string>& blocks) {
  std::vector<ActionSpec> actions;
  for (int kind = 0; kind < kStackingKinds; ++kind) {
    const std::string name = ToString(static_cast<StackingKind>(kind));
    for (const std::string& block : blocks) {
      const int index = static_cast<int>(actions.size());
      actions.push_back({index, name + "(" + block + ")", name, block});
    }
  }
  return actions;
}

std::vector<std::vector<int>> StackingSuccessors(int blocks) {
  std::vector<std::vector<int>> rows;
  for (int action = 0; action < kStackingKinds * blocks; ++action) {
    const StackingAction from = StackingActionAt(action, blocks);
    rows.push_back(MayTryAgain(from.kind) ? AllOf(StackingKind::kAlign, blocks)
                                          : std::vector<int>{});
    const std::vector<int> onward = Onward(from, blocks);
    rows.back().insert(rows.back().end(), onward.begin(), onward.end());
  }
  rows.push_back(AllOf(StackingKind::kAlign, blocks));
  return rows;
}

}  // namespace prospect::sim

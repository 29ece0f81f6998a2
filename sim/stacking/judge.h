#pragma once

#include <vector>

#include "sim/stacking/outcome.h"
#include "sim/stacking/parameters.h"
#include "sim/tabletop/tabletop_world.h"
#include "sim/task.h"

namespace prospect::sim {

// Every reason that a verdict can give, in words.
std::vector<CauseSpec> StackingCauses();

// Looks at the world and says how the trial stands. Stateless.
class StackingJudge {
 public:
  StackingJudge(const StackingParameters& parameters, const ArmDescription& arm, int tower)
      : p_(parameters), joint_limit_(arm.position_limit), tower_(tower) {}

  // After every physics step: what ends a trial on the spot.
  StackingVerdict AfterStep(const TabletopWorld& world) const;

  // After every tick: limits, lost blocks, success.
  StackingVerdict AfterTick(const TabletopWorld& world) const;

  // Whether the tool is at the home point and the joints are slow.
  bool IsHome(const TabletopWorld& world) const;

  // Blocks in the highest tower that stands still with no hand on it; 1 if none is stacked.
  int TowerHeight(const TabletopWorld& world) const;

  // Whether block `upper` lies still on block `lower` with no hand on either.
  bool RestsOn(const TabletopWorld& world, int upper, int lower) const;

 private:
  int HeightAbove(const TabletopWorld& world, int base) const;
  StackingVerdict Limits(const TabletopWorld& world) const;

  const StackingParameters& p_;
  JointVector joint_limit_;
  int tower_;
};

// Whether every joint is slower than `limit` (rad/s).
bool JointsSlow(const ArmChain& arm, double limit);

}  // namespace prospect::sim

#pragma once

#include <string>

namespace prospect::sim {

// How a stacking trial ends. The first cause wins.
enum class StackingOutcome {
  kRunning,
  kSuccess,        // a tower stands, no hand on it, and the arm is home
  kObstacle,       // the robot or the held block touched the obstacle
  kTime,           // out of time
  kWorkspace,      // the tool left the workspace, a joint its limits, or the robot hit the table
  kUnreachable,    // no joints bring the tool where the controller wants it
  kBlockLost,      // a block fell off the table
  kPlanExhausted,  // the plan, or all tries, ended without a tower
};

// "running", "success", "obstacle", "time", "workspace", "unreachable", "block_lost",
// "plan_exhausted".
const char* ToString(StackingOutcome outcome);

// A verdict with what exactly happened.
struct StackingVerdict {
  StackingOutcome outcome = StackingOutcome::kRunning;
  std::string detail;  // "gripper", "joint 3", "table", ...; may be empty

  // "obstacle(gripper)", "time"; empty unless the trial failed.
  std::string Reason() const;
};

}  // namespace prospect::sim

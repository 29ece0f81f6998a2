#pragma once

#include "services/executive/bus_mind.h"

namespace prospect::services {

/// The yardstick of planning: in each state, seen or imagined, the action with the highest Q
/// (planner::GreedyPlan), asked of the model servers. Refuses no plan for its score. As BusMind.
class GreedyMind : public BusMind {
 public:
  using BusMind::BusMind;
  agent::SearchAnswer Search(const agent::SearchQuestion& question) override;
};

}  // namespace prospect::services

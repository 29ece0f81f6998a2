#pragma once

#include <gtest/gtest.h>
#include <signal.h>

#include <string>

#include "services/common/clock.h"
#include "tests/integration/support/process.h"
#include "tests/integration/support/witness.h"

namespace prospect::tests {

inline bool LatestStatusIs(const Witness& witness, int state) {
  return !witness.statuses.empty() && witness.statuses.back().state == state;
}

/// Kills the executive of a running action: the robot stops after 3 s of silence, neither at the
/// first missing sign of life nor much later.
inline void ExpectTheRobotStopsWithout(Process& executive, Witness& witness) {
  ASSERT_TRUE(LatestStatusIs(witness, action_status_t::STATE_RUNNING));
  executive.Signal(SIGKILL);
  const std::int64_t killed_ms = services::SteadyMs();
  ASSERT_TRUE(witness.Until(
      [&] { return LatestStatusIs(witness, action_status_t::STATE_CANCELLED); }, 6000))
      << "state " << int{witness.statuses.back().state};
  EXPECT_LT(services::SteadyMs() - killed_ms, 4500);
  EXPECT_GT(services::SteadyMs() - killed_ms, 1500)
      << "one missing sign of life must not stop the robot";
}

}  // namespace prospect::tests

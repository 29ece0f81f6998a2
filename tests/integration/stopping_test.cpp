// Commands are carried out once, and whatever moves stops when nobody answers for it any more.

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <string>

#include "services/common/clock.h"
#include "tests/integration/support/commander.h"
#include "tests/integration/support/deployment.h"
#include "tests/integration/support/stops_in_time.h"

namespace prospect::tests {
namespace {

// Slow enough that an action lasts many seconds.
const std::vector<std::string> kSlow{"--frames-per-second", "4"};

// Under way and well off its start: an action whose object is at hand ends at once.
bool UnderWay(const Witness& witness) {
  return !witness.statuses.empty() &&
         witness.statuses.back().state == action_status_t::STATE_RUNNING &&
         !witness.labels.empty() && witness.labels.rbegin()->second.frame >= 4;
}

bool Running(const Witness& witness) {
  return !witness.statuses.empty() &&
         witness.statuses.back().state == action_status_t::STATE_RUNNING;
}

bool Cancelled(const Witness& witness) {
  return !witness.statuses.empty() &&
         witness.statuses.back().state == action_status_t::STATE_CANCELLED;
}

std::int64_t ElapsedMs(std::int64_t since_ms) { return services::SteadyMs() - since_ms; }

TEST(Stopping, KilledExecutiveStopsTheRobot) {
  Witness witness;
  Deployment deployment("killed");
  deployment.Simulator(kSlow);
  auto& executive = deployment.Executive({"--policy", "plan:0,1,2"});
  ASSERT_TRUE(witness.Until([&] { return UnderWay(witness); }, 15000));
  ExpectTheRobotStopsWithout(executive, witness);
}

TEST(Stopping, KilledExecutiveStopsTheExample) {
  Witness witness;
  Deployment deployment("killed_example");
  Process robot("examples/example-robot", {"--bus", witness.bus.url()},
                deployment.folder + "/robot.log");
  // An action of the example lasts longer than the silence that stops it.
  auto& executive = deployment.Executive({"--no-reset", "--policy", "plan:0,8"});
  ASSERT_TRUE(witness.Until([&] { return LatestStatusIs(witness, action_status_t::STATE_RUNNING); },
                            20000));
  ExpectTheRobotStopsWithout(executive, witness);
  const std::int64_t frame = witness.statuses.back().frame;
  witness.Listen(1000);
  EXPECT_EQ(witness.statuses.back().frame, frame) << "it should stand still";
}

TEST(Stopping, InterruptedExecutiveCancelsAtOnce) {
  Witness witness;
  Deployment deployment("interrupted");
  deployment.Simulator(kSlow);
  auto& executive = deployment.Executive({"--policy", "plan:0,1,2"});
  ASSERT_TRUE(witness.Until([&] { return UnderWay(witness); }, 15000));
  executive.Signal(SIGINT);
  const std::int64_t interrupted_ms = services::SteadyMs();
  ASSERT_TRUE(witness.Until([&] { return Cancelled(witness); }, 6000));
  EXPECT_LT(ElapsedMs(interrupted_ms), 1500);
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 5000));
  EXPECT_EQ(code, 130);
}

bool Ended(const Witness& witness, std::int64_t id) {
  return !witness.statuses.empty() && witness.statuses.back().command_id == id && !Running(witness);
}

TEST(Commands, DuplicatesAreCarriedOutOnce) {
  Witness witness;
  Deployment deployment("duplicates");
  deployment.Simulator();
  ASSERT_TRUE(witness.Until(
      [&] { return witness.Ready("simulator", 1) && witness.episode_id >= 0; }, 10000));
  Commander commander(witness);
  const auto start = commander.Start(5, 0);
  const auto flood = [&] {
    commander.Beat();
    for (int i = 0; i < 10; ++i) commander.Say(start);
  };
  ASSERT_TRUE(witness.Until([&] { return Ended(witness, 5); }, 20000, flood));
  EXPECT_NE(witness.statuses.back().state, action_status_t::STATE_REFUSED)
      << witness.statuses.back().reason;
  const std::int64_t frames = witness.labels.rbegin()->first;

  // The same command again, and one with an id that is not new, must change nothing.
  const auto older = commander.Start(4, 1);
  const auto again = [&] { commander.Say(start), commander.Say(older); };
  witness.Until([] { return false; }, 700, again);
  EXPECT_EQ(witness.labels.rbegin()->first, frames);
  EXPECT_EQ(witness.labels.rbegin()->second.segment, 0);
}

TEST(Commands, OtherEpisodesAndImpossibleActionsAreRefused) {
  Witness witness;
  Deployment deployment("refused_commands");
  deployment.Simulator();
  ASSERT_TRUE(witness.Until(
      [&] { return witness.Ready("simulator", 1) && witness.episode_id >= 0; }, 10000));
  Commander commander(witness);
  auto elsewhere = commander.Start(1, 0);
  elsewhere.episode_id += 17;
  const auto refused = [&](std::int64_t id) {
    return !witness.statuses.empty() && witness.statuses.back().command_id == id &&
           witness.statuses.back().state == action_status_t::STATE_REFUSED;
  };
  EXPECT_TRUE(witness.Until([&] { return refused(1); }, 5000, [&] { commander.Say(elsewhere); }));
  EXPECT_TRUE(witness.Until([&] { return refused(2); }, 5000,
                            [&] { commander.Say(commander.Start(2, 200)); }));
  EXPECT_EQ(witness.labels.rbegin()->first, 0);
}

}  // namespace
}  // namespace prospect::tests

// Shared statistics over real LCM with a bad network at every ear: counts are exact whenever
// digests agree, they come to agree, and nothing that was changed on the way changes a row.

#include <gtest/gtest.h>

#include "tests/faults/sharing_peers.h"

namespace prospect::tests {
namespace {

constexpr int kTicks = 100;
constexpr int kRollouts = 3;

std::int64_t RolloutsKnown(const Peer& peer) {
  return peer.statistics().totals(planner::kRoot).visits;
}

std::int64_t RolloutsMade(const Peers& peers) {
  std::int64_t sum = 0;
  for (const auto& peer : peers.peers) sum += peer->statistics().own_totals().rollouts;
  return sum;
}

void ExpectExactCounts(const Peers& peers) {
  for (const auto& peer : peers.peers) {
    EXPECT_EQ(RolloutsKnown(*peer), RolloutsMade(peers));
    EXPECT_EQ(peer->statistics().totals(planner::kRoot).in_flight, 0);
  }
}

TEST(StatisticsOverLcm, AgreeAtOnceWithoutLoss) {
  Peers peers("");
  peers.Work(kTicks, kRollouts);
  peers.Finish();
  const int rounds = peers.RoundsUntilAgreed();
  RecordProperty("rounds", rounds);
  EXPECT_GE(rounds, 0);
  EXPECT_LE(rounds, 1);
  EXPECT_GT(peers.agreements(), 0);
  ExpectExactCounts(peers);
}

// The bound that docs/network.md states: six rounds at 30 % loss.
TEST(StatisticsOverLcm, AgreeAtThirtyPercentLossWithDuplicatesAndReordering) {
  Peers peers("drop=0.3,dup=0.1,reorder=0.2,delay=5");
  peers.Work(kTicks, kRollouts);
  peers.CheckExact();
  peers.Finish();
  const int rounds = peers.RoundsUntilAgreed();
  RecordProperty("rounds", rounds);
  EXPECT_GE(rounds, 0) << "they never agreed";
  EXPECT_LE(rounds, 6);
  peers.CheckExact();
  ExpectExactCounts(peers);
}

TEST(StatisticsOverLcm, AgreeWithinTwoRoundsOnceLossStops) {
  Peers peers("drop=0.9");
  peers.Work(kTicks, kRollouts);
  peers.Finish();
  ASSERT_FALSE(peers.Agreed()) << "the loss did nothing";
  peers.SetChaos("");
  const int rounds = peers.RoundsUntilAgreed();
  RecordProperty("rounds", rounds);
  EXPECT_GE(rounds, 0) << "they never agreed";
  EXPECT_LE(rounds, 2);
  ExpectExactCounts(peers);
}

TEST(StatisticsOverLcm, CorruptedMessagesNeverChangeARow) {
  Peers peers("corrupt=0.5,dup=0.2,reorder=0.2");
  peers.Work(kTicks, kRollouts);
  peers.CheckExact();
  peers.Finish();
  EXPECT_GE(peers.RoundsUntilAgreed(), 0) << "they never agreed";
  peers.CheckExact();
  ExpectExactCounts(peers);
  for (const auto& peer : peers.peers) {
    const std::int64_t refused = peer->bus().refused() + peer->statistics().refusals().total();
    EXPECT_GT(refused, kTicks) << "hardly anything was corrupted";
  }
}

}  // namespace
}  // namespace prospect::tests

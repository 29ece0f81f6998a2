#include "services/simulator/command_gate.h"

#include <gtest/gtest.h>

namespace prospect::services {
namespace {

TEST(CommandGateTest, EachCommandOnceAndNoOldOnes) {
  CommandGate gate;
  EXPECT_TRUE(gate.Take(1, 5));
  EXPECT_FALSE(gate.Take(1, 5));
  EXPECT_FALSE(gate.Take(1, 4));
  EXPECT_TRUE(gate.Take(1, 6));
  EXPECT_TRUE(gate.Take(2, 5));
  EXPECT_FALSE(gate.Take(1, 5));
}

TEST(CommandGateTest, ForgetsTheSenderUnheardForLongest) {
  CommandGate gate(2);
  EXPECT_TRUE(gate.Take(1, 9));
  EXPECT_TRUE(gate.Take(2, 9));
  EXPECT_TRUE(gate.Take(1, 10));
  EXPECT_TRUE(gate.Take(3, 9));
  EXPECT_FALSE(gate.Take(1, 10));
  EXPECT_TRUE(gate.Take(2, 9));
}

}  // namespace
}  // namespace prospect::services

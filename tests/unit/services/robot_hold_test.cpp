#include "services/common/robot_hold.h"

#include <gtest/gtest.h>

namespace prospect::services {
namespace {

constexpr std::int64_t kFirst = 7, kSecond = 8;

health_t HealthOf(std::int64_t id, std::int8_t state = health_t::STATE_BUSY) {
  health_t health{};
  health.instance_id = id;
  health.state = state;
  return health;
}

TEST(RobotHold, TheFirstHoldsItAndOthersAreTold) {
  RobotHold hold;
  EXPECT_EQ(hold.BusyFor(kFirst), "");
  EXPECT_FALSE(hold.Lapsed(0)) << "nobody holds it";
  hold.Take(kFirst, 0);
  EXPECT_EQ(hold.holder(), kFirst);
  EXPECT_EQ(hold.BusyFor(kFirst), "");
  EXPECT_EQ(hold.BusyFor(kSecond), "busy, held by executive 7");
}

TEST(RobotHold, LastsWhileTheHolderGivesASignOfLife) {
  RobotHold hold;
  hold.Take(kFirst, 1000);
  EXPECT_FALSE(hold.Lapsed(4000));
  EXPECT_TRUE(hold.Lapsed(4001));
  hold.Hear(HealthOf(kFirst), 3500);
  EXPECT_FALSE(hold.Lapsed(6500));
  hold.Hear(HealthOf(kSecond), 6000);
  EXPECT_TRUE(hold.Lapsed(6501)) << "another's life is none of its";
  hold.Take(kFirst, 7000);
  EXPECT_FALSE(hold.Lapsed(10000)) << "a command is a sign of life, too";
  hold.Free();
  EXPECT_EQ(hold.BusyFor(kSecond), "");
}

TEST(RobotHold, EndsWhenTheHolderSaysThatItLeaves) {
  RobotHold hold;
  hold.Take(kFirst, 0);
  hold.Hear(HealthOf(kSecond, health_t::STATE_DRAINING), 10);
  EXPECT_FALSE(hold.Lapsed(10));
  hold.Hear(HealthOf(kFirst, health_t::STATE_DRAINING), 20);
  EXPECT_TRUE(hold.Lapsed(20));
  hold.Take(kFirst, 30);
  EXPECT_FALSE(hold.Lapsed(30)) << "it came back";
}

}  // namespace
}  // namespace prospect::services

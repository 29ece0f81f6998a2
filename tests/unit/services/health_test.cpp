#include "services/common/health.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "services/common/health_monitor.h"
#include "services/common/ids.h"
#include "tests/unit/services/poll_until.h"

namespace prospect::services {
namespace {

// Each test starts and ends as a process without a deployment.
class Health : public testing::Test {
 protected:
  void SetUp() override { SetDeploymentId(0); }
  void TearDown() override { SetDeploymentId(0); }

  Bus bus_;
};

TEST_F(Health, ABeaconIsHeardWithAllItSays) {
  HealthMonitor monitor(bus_);
  HealthBeacon beacon(bus_, "model");
  beacon.SetCounter("batches", 7);
  beacon.SetQueue(3);
  bus_.CountRefused("TASK", "truncated");
  beacon.SetState(health_t::STATE_READY);
  beacon.Tick();
  ASSERT_TRUE(PollUntil({&bus_}, [&] { return monitor.IsAlive(beacon.instance_id()); }));

  ASSERT_EQ(monitor.Alive("model").size(), 1u);
  EXPECT_TRUE(monitor.Alive("worker").empty());
  const health_t health = monitor.Alive().front().health;
  EXPECT_EQ(health.state, health_t::STATE_READY);
  EXPECT_EQ(health.pid, getpid());
  EXPECT_EQ(health.queue, 3);
  EXPECT_EQ(health.refused, 1);
  EXPECT_GT(health.rss_kb, 0);
  ASSERT_EQ(health.counters.size(), 2u);
  EXPECT_EQ(health.counters[0].name, "batches");
  EXPECT_EQ(health.counters[1].name, "TASK: truncated");
}

TEST_F(Health, BeatsOncePerSecondAndOnChange) {
  int beats = 0;
  const auto subscription = bus_.Subscribe<health_t>([&](const health_t&) { ++beats; });
  HealthBeacon beacon(bus_, "worker");
  for (int i = 0; i < 50; ++i) beacon.Tick();
  ASSERT_TRUE(PollUntil({&bus_}, [&] { return beats == 1; }));
  beacon.SetState(health_t::STATE_READY);
  beacon.SetState(health_t::STATE_READY);
  for (int i = 0; i < 50; ++i) beacon.Tick();
  EXPECT_TRUE(PollUntil({&bus_}, [&] { return beats == 2; }));
  const std::int64_t start_ms = SteadyMs();
  ASSERT_TRUE(PollUntil({&bus_}, [&] {
    beacon.Tick();
    return beats == 3;
  }));
  EXPECT_GE(SteadyMs() - start_ms, 900);
}

TEST_F(Health, SilenceIsDeathAndSoIsDraining) {
  HealthMonitor monitor(bus_);
  HealthBeacon beacon(bus_, "worker");
  beacon.PublishNow();
  ASSERT_TRUE(PollUntil({&bus_}, [&] { return monitor.IsAlive(beacon.instance_id()); }));
  const std::int64_t start_ms = SteadyMs();
  ASSERT_TRUE(PollUntil({&bus_}, [&] { return !monitor.IsAlive(beacon.instance_id()); }));
  EXPECT_NEAR(static_cast<double>(SteadyMs() - start_ms), 3000, 500);
  EXPECT_NE(monitor.Find(beacon.instance_id()), nullptr);

  beacon.SetState(health_t::STATE_READY);
  beacon.PublishNow();
  ASSERT_TRUE(PollUntil({&bus_}, [&] { return monitor.IsAlive(beacon.instance_id()); }));
  beacon.SetState(health_t::STATE_DRAINING);
  beacon.PublishNow();
  EXPECT_TRUE(PollUntil(
      {&bus_}, [&] { return !monitor.IsAlive(beacon.instance_id()); }, 1500));
}

TEST_F(Health, AnotherDeploymentIsForeign) {
  HealthMonitor monitor(bus_);
  SetDeploymentId(77);
  HealthBeacon foreign(bus_, "simulator");
  SetDeploymentId(78);
  HealthBeacon own(bus_, "model");
  foreign.PublishNow();
  own.PublishNow();
  ASSERT_TRUE(PollUntil({&bus_}, [&] { return monitor.IsAlive(own.instance_id()); }));
  ASSERT_TRUE(monitor.Foreign().has_value());
  EXPECT_EQ(monitor.Foreign()->health.instance_id, foreign.instance_id());
  ASSERT_EQ(monitor.Alive().size(), 1u);
  EXPECT_EQ(monitor.Alive().front().health.instance_id, own.instance_id());

  // Whoever has no deployment joins all.
  SetDeploymentId(0);
  EXPECT_FALSE(monitor.Foreign().has_value());
  EXPECT_EQ(monitor.Alive().size(), 2u);
}

// A worker started by hand, on this machine or another, takes part in whatever deployment it finds.
TEST_F(Health, WhoeverHasNoDeploymentIsNotForeign) {
  HealthMonitor monitor(bus_);
  SetDeploymentId(0);
  HealthBeacon joining(bus_, "worker");
  SetDeploymentId(78);
  joining.PublishNow();
  ASSERT_TRUE(PollUntil({&bus_}, [&] { return monitor.IsAlive(joining.instance_id()); }));
  EXPECT_FALSE(monitor.Foreign().has_value());
  EXPECT_EQ(monitor.Alive("worker").size(), 1u);
}

TEST_F(Health, ABusInUseIsAnErrorThatNamesTheOther) {
  HealthMonitor monitor(bus_);
  SetDeploymentId(77);
  HealthBeacon foreign(bus_, "simulator");
  SetDeploymentId(78);
  foreign.PublishNow();
  try {
    monitor.RequireOwnBus(1200);
    FAIL() << "no error";
  } catch (const ExitError& error) {
    EXPECT_EQ(error.code(), kExitBusInUse);
    EXPECT_NE(std::string(error.what()).find("simulator, pid " + std::to_string(getpid())),
              std::string::npos);
  }
}

TEST_F(Health, AQuietBusIsOursAfterListening) {
  HealthMonitor monitor(bus_);
  SetDeploymentId(78);
  HealthBeacon own(bus_, "model");
  own.PublishNow();
  const std::int64_t start_ms = SteadyMs();
  EXPECT_NO_THROW(monitor.RequireOwnBus(300));
  EXPECT_GE(SteadyMs() - start_ms, 300);
}

}  // namespace
}  // namespace prospect::services

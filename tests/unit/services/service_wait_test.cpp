#include "services/spy/service_wait.h"

#include <gtest/gtest.h>

#include <functional>

#include "services/common/health.h"
#include "services/common/ids.h"
#include "tests/unit/services/poll_until.h"

namespace prospect::services {
namespace {

ExitCode CodeOf(const std::function<void()>& body) {
  try {
    body();
  } catch (const ExitError& error) {
    return error.code();
  }
  return kExitSuccess;
}

class ServiceWait : public testing::Test {
 protected:
  void TearDown() override { SetDeploymentId(0); }

  Bus bus_;
  HealthMonitor monitor_{bus_};
};

TEST(ParseServices, ReadsNamesAndCounts) {
  EXPECT_EQ(ParseServices("simulator=1,model,worker=2"),
            (ServiceCounts{{"model", 1}, {"simulator", 1}, {"worker", 2}}));
  for (const char* bad : {"", "=2", "worker=", "worker=x", "worker=-1", "a,,b", "worker=1=2"}) {
    EXPECT_EQ(CodeOf([&] { ParseServices(bad); }), kExitUsage) << bad;
  }
}

TEST_F(ServiceWait, ReturnsOnceAllAreReady) {
  HealthBeacon model(bus_, "model");
  HealthBeacon first(bus_, "worker");
  HealthBeacon second(bus_, "worker");
  model.SetState(health_t::STATE_READY);
  first.SetState(health_t::STATE_BUSY);
  model.PublishNow();
  first.PublishNow();
  second.PublishNow();  // it only starts
  const ServiceCounts wanted = {{"model", 1}, {"worker", 2}};
  ASSERT_TRUE(PollUntil({&bus_}, [&] { return monitor_.Alive().size() == 3; }));
  EXPECT_EQ(MissingServices(wanted, monitor_), (ServiceCounts{{"worker", 1}}));
  second.SetState(health_t::STATE_READY);
  second.PublishNow();
  EXPECT_NO_THROW(WaitForServices(bus_, monitor_, wanted, 5));
}

TEST_F(ServiceWait, NamesWhatIsMissingAndWhy) {
  HealthBeacon model(bus_, "model");
  model.SetState(health_t::STATE_FAULT, "weights are for another task");
  model.PublishNow();
  try {
    WaitForServices(bus_, monitor_, {{"model", 1}, {"worker", 2}}, 0.3);
    FAIL() << "no error";
  } catch (const ExitError& error) {
    EXPECT_EQ(error.code(), kExitTimeout);
    const std::string text = error.what();
    EXPECT_NE(text.find("1 model, 2 worker; model says: weights are for another task"),
              std::string::npos)
        << text;
  }
}

TEST_F(ServiceWait, AnotherDeploymentEndsTheWait) {
  SetDeploymentId(1);
  HealthBeacon foreign(bus_, "model");
  foreign.PublishNow();
  SetDeploymentId(2);
  EXPECT_EQ(CodeOf([&] { WaitForServices(bus_, monitor_, {{"model", 1}}, 5); }), kExitBusInUse);
}

}  // namespace
}  // namespace prospect::services

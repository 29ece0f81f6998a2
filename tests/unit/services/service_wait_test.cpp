#include "services/spy/service_wait.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <functional>
#include <string>

#include "base/disk_error.h"
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

TEST_F(ServiceWait, SomebodyIsAProcessOrARobotWithoutHealth) {
  EXPECT_EQ(CodeOf([&] { RequireSomebody(bus_, monitor_, 0.2); }), kExitServiceLost);
  task_t task{};
  task.name = "navigation";
  task.actions.resize(1);
  task.actions[0].name = "investigate";
  task.plan_length = task.image_width = task.image_height = 1;
  task.tick_seconds = task.action_time_limit = 1;
  messages::SetCounts(task);
  bus_.Publish(task);
  EXPECT_NO_THROW(RequireSomebody(bus_, monitor_, 5));
  HealthBeacon worker(bus_, "worker");
  worker.PublishNow();
  ASSERT_TRUE(PollUntil({&bus_}, [&] { return !monitor_.Alive().empty(); }));
  EXPECT_NO_THROW(RequireSomebody(bus_, monitor_, 0.2));
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

// Two workers whose host and pid are the same, as in two containers: each file asks for its own.
class InstanceFile : public ServiceWait {
 protected:
  void TearDown() override {
    SetInstanceFile("");
    for (const auto& file : {first_, second_}) std::remove(file.c_str());
    ServiceWait::TearDown();
  }

  const std::string first_ = testing::TempDir() + "instance-1-" + std::to_string(getpid());
  const std::string second_ = testing::TempDir() + "instance-2-" + std::to_string(getpid());
};

TEST_F(InstanceFile, TellsAWorkerFromItsTwin) {
  EXPECT_EQ(CodeOf([&] { ReadInstanceFile(first_); }), kExitDataFile);
  SetInstanceFile(first_);
  HealthBeacon first(bus_, "worker");
  SetInstanceFile(second_);
  HealthBeacon second(bus_, "worker");
  SetInstanceFile("");
  HealthBeacon none(bus_, "worker");
  EXPECT_EQ(ReadInstanceFile(first_), first.instance_id());
  ASSERT_EQ(ReadInstanceFile(second_), second.instance_id());
  first.SetState(health_t::STATE_BUSY);
  first.PublishNow();
  EXPECT_EQ(WaitForInstance(bus_, monitor_, first.instance_id(), 5).instance_id,
            first.instance_id());
  EXPECT_EQ(CodeOf([&] { WaitForInstance(bus_, monitor_, second.instance_id(), 0.3); }),
            kExitServiceLost);
}

TEST_F(InstanceFile, AFaultIsNoHealth) {
  HealthBeacon model(bus_, "model");
  model.SetState(health_t::STATE_FAULT, "weights are for another task");
  model.PublishNow();
  try {
    WaitForInstance(bus_, monitor_, model.instance_id(), 0.3);
    FAIL() << "no error";
  } catch (const ExitError& error) {
    EXPECT_EQ(error.code(), kExitServiceLost);
    EXPECT_STREQ(error.what(), "model is not at work: state fault: weights are for another task");
  }
}

TEST_F(InstanceFile, MustBeWritable) {
  SetInstanceFile("/no/such/folder/instance");
  EXPECT_THROW(HealthBeacon(bus_, "worker"), base::DiskError);
}

}  // namespace
}  // namespace prospect::services

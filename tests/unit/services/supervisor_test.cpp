#include <gtest/gtest.h>

#include "services/spy/status.h"
#include "services/supervisor/deployment.h"
#include "services/supervisor/restart_policy.h"

namespace prospect::services {
namespace {

TEST(RestartPolicy, AtOnceThenAfterLongerAndLongerPauses) {
  RestartPolicy policy;
  EXPECT_EQ(policy.AfterEnd(137, 100), 0);
  EXPECT_EQ(policy.AfterEnd(137, 100), 500);
  EXPECT_EQ(policy.AfterEnd(1, 100), 1000);
  for (int i = 0; i < 10; ++i) policy.AfterEnd(1, 100);
  EXPECT_EQ(policy.AfterEnd(1, 100), RestartPolicy::kLongestPauseMs);
  EXPECT_EQ(policy.AfterEnd(1, RestartPolicy::kHealthyMs), 0) << "it had been well for long";
}

TEST(RestartPolicy, NotAfterWhatAnotherStartCannotMend) {
  for (const int status : {2, 10, 11, 12, 13, 14, 127}) {
    EXPECT_FALSE(RestartPolicy().AfterEnd(status, 100).has_value()) << status;
  }
  for (const int status : {0, 1, 15, 134, 137, 139}) {
    EXPECT_TRUE(RestartPolicy().AfterEnd(status, 100).has_value()) << status;
  }
}

TEST(MoveSeeds, MovesEachAndLeavesTheRest) {
  EXPECT_EQ(MoveSeeds("drop=0.3,seed=5", 3), "drop=0.3,seed=8");
  EXPECT_EQ(MoveSeeds("seed=1,drop=0.1;dup=0.5,seed=9", 1), "seed=2,drop=0.1;dup=0.5,seed=10");
  EXPECT_EQ(MoveSeeds("drop=0.3", 3), "drop=0.3");
  EXPECT_EQ(MoveSeeds("", 3), "");
}

TEST(DeploymentSpec, SaysHowEachServiceIsStarted) {
  DeploymentSpec spec;
  spec.programs = "/bin";
  spec.bus = "udpm://x";
  spec.task = "stacking";
  spec.weights = "w.safetensors";
  spec.chaos = "drop=0.5,seed=1";
  spec.scene = {"--tower", "3"};
  EXPECT_EQ(SimulatorSpec(spec).command,
            (std::vector<std::string>{"/bin/prospect-simulator", "--bus", "udpm://x", "--chaos",
                                      "drop=0.5,seed=3", "--task", "stacking", "--tower", "3"}));
  spec.player = true;
  EXPECT_EQ(SimulatorSpec(spec).command[0], "/bin/prospect-video");
  EXPECT_EQ(SimulatorSpec(spec).command[1], "play");
  EXPECT_EQ(ModelSpec(spec).command.back(), "w.safetensors");
  EXPECT_EQ(WorkerSpec(spec, 2).name, "worker-2");
  spec.chaos.clear();
  EXPECT_EQ(WorkerSpec(spec, 2).command,
            (std::vector<std::string>{"/bin/prospect-worker", "--bus", "udpm://x"}));
}

TEST(Status, NamesTheSupervisedAndKeepsTheRest) {
  HealthMonitor::Peer remote;
  remote.health.service = "worker";
  remote.health.host = "elsewhere";
  remote.health.pid = 10;
  remote.health.state = health_t::STATE_BUSY;
  remote.heard_ms = 4000;
  const nlohmann::json file = {{"services",
                                {{{"name", "worker-1"},
                                  {"pid", 10},
                                  {"state", "running"},
                                  {"restarts", 2},
                                  {"last_exit", 137},
                                  {"last_words", "bye"}}}}};
  const auto rows = StatusRows({remote}, file, 5000);
  ASSERT_EQ(rows.size(), 2u) << "the same process id on another machine is another process";
  EXPECT_EQ(rows[0].name, "worker-1");
  EXPECT_EQ(rows[0].state, "silent");
  EXPECT_EQ(rows[0].restarts, 2);
  EXPECT_EQ(rows[0].note, "killed by signal 9");
  EXPECT_EQ(rows[1].name, "worker");
  EXPECT_EQ(rows[1].state, "busy");
  EXPECT_DOUBLE_EQ(rows[1].age_s, 1.0);
  EXPECT_FALSE(AllWell(rows));
  EXPECT_TRUE(AllWell({rows[1]}));
  EXPECT_FALSE(AllWell({}));
}

}  // namespace
}  // namespace prospect::services

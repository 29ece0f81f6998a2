// The stacking world over the same messages as every other world.

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "tests/integration/support/commander.h"
#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

const std::vector<std::string> kStacking{"--task", "stacking"};

bool SimulatorShows(const Witness& witness) {
  return witness.Ready("simulator", 1) && witness.episode_id >= 0;
}

// The state that ended command `id`, or STATE_UNKNOWN while there is none.
int EndOf(const Witness& witness, std::int64_t id) {
  for (const action_status_t& status : witness.statuses) {
    if (status.command_id != id || status.state == action_status_t::STATE_RUNNING) continue;
    return status.state;
  }
  return action_status_t::STATE_UNKNOWN;
}

TEST(Stacking, AnExpertEpisodeOverTheBus) {
  Witness witness;
  Deployment deployment("stacking_expert");
  deployment.Simulator(kStacking);
  auto& executive = deployment.Executive(
      {"--policy", "expert", "--tower", "2", "--services-timeout-ms", "20000"}, 4);
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 90000));
  const auto result = deployment.Result();
  EXPECT_EQ(code, result["outcome"] == "solved" ? 0 : 4);
  EXPECT_EQ(result["task"], "stacking");
  ASSERT_FALSE(result["actions"].empty());
  EXPECT_EQ(result["actions"][0].get<std::string>().substr(0, 6), "align(");
  if (code == 0) {
    EXPECT_EQ(result["actions"].size(), 9u);
  } else {
    EXPECT_FALSE(result["reason"].get<std::string>().empty());
  }
  EXPECT_GT(witness.labels.size(), 30u) << "a label a picture";
}

// With no tolerance every picture is a surprise, so the first plan is taken for lost at the last
// action after which another one can be begun: the whole way through workers, server and simulator.
TEST(Stacking, ALostPlanIsBegunAnew) {
  Witness witness;
  Deployment deployment("stacking_anew");
  deployment.Simulator(kStacking);
  const Process server("prospect-model-server",
                       {"--weights", PROSPECT_ROOT "/model/weights/stacking.safetensors"},
                       deployment.folder + "/model.log");
  deployment.Worker();
  auto& executive =
      deployment.Executive({"--tower", "2", "--surprise", "0", "--refusal-threshold", "0.01",
                            "--samples", "20", "--services-timeout-ms", "20000"},
                           1000103);
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 90000));
  const auto result = deployment.Result();
  ASSERT_GT(result["actions"].size(), 8u) << result["reason"];
  const auto name = [&](int i) { return result["actions"][i].get<std::string>(); };
  EXPECT_EQ(name(6).substr(0, 5), "open(");
  EXPECT_EQ(name(7).substr(0, 9), "back_off(") << "now the gripper hides nothing";
  EXPECT_EQ(name(8).substr(0, 6), "align(");
  EXPECT_EQ(result["searches"][8]["note"].get<std::string>().substr(0, 11), "begins anew");
  EXPECT_EQ(result["searches"][8]["plan"].size(), 9u) << "a whole plan";
  EXPECT_FALSE(result["searches"][7].contains("note"));
}

// What was imagined tells a plan that goes wrong: without it nothing is begun, unless that is said.
TEST(Stacking, WithoutImaginedPicturesNothingIsDone) {
  Witness witness;
  Deployment deployment("stacking_blind");
  deployment.Simulator(kStacking);
  deployment.ModelServer({"--weights", PROSPECT_ROOT "/model/weights/stacking.safetensors"});
  deployment.Worker();
  std::vector<std::string> blind{"--tower",
                                 "2",
                                 "--refusal-threshold",
                                 "0.01",
                                 "--samples",
                                 "20",
                                 "--services-timeout-ms",
                                 "20000",
                                 "--novelty",
                                 "0",
                                 "--chaos",
                                 "drop=1,channel=PREDICT_REPLY"};
  auto& executive = deployment.Executive(blind, 1000103);
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000));
  EXPECT_EQ(code, 3);
  EXPECT_TRUE(witness.commands.empty());
  const std::string reason = deployment.Result().at("reason");
  EXPECT_NE(reason.find("no server drew what is to be seen after step 1, align("),
            std::string::npos)
      << reason;
  EXPECT_NE(reason.find("--surprise 1"), std::string::npos) << reason;

  blind.insert(blind.end(), {"--surprise", "1"});
  deployment.Executive(blind, 1000103);
  EXPECT_TRUE(witness.Until([&] { return !witness.commands.empty(); }, 60000));
}

TEST(Stacking, RefusesWhatTheTableAndTheGraphForbid) {
  Witness witness;
  Deployment deployment("stacking_refused");
  deployment.Simulator(kStacking);
  ASSERT_TRUE(witness.Until([&] { return SimulatorShows(witness); }, 20000));
  Commander commander(witness);
  std::int64_t id = 0;
  const auto expect_refusal = [&](int action, const std::string& why) {
    const auto command = commander.Start(++id, action);
    const auto say = [&] { commander.Beat(), commander.Say(command); };
    ASSERT_TRUE(witness.Until([&] { return EndOf(witness, id) != 0; }, 5000, say));
    EXPECT_EQ(EndOf(witness, id), action_status_t::STATE_REFUSED);
    EXPECT_NE(witness.statuses.back().reason.find(why), std::string::npos)
        << witness.statuses.back().reason;
  };
  expect_refusal(36, "not in the table");
  expect_refusal(32, "home(");  // home, before anything was picked up
  EXPECT_EQ(witness.labels.rbegin()->first, 0) << "the world stood still";

  const auto align = commander.Start(++id, 0);
  const auto say = [&] { commander.Beat(), commander.Say(align); };
  ASSERT_TRUE(witness.Until([&] { return EndOf(witness, id) != 0; }, 60000, say));
  EXPECT_NE(EndOf(witness, id), action_status_t::STATE_REFUSED);
  const bool goes_on = EndOf(witness, id) == action_status_t::STATE_SUCCEEDED;
  expect_refusal(9, goes_on ? "close(" : "over");  // closing before the fingers are about the block
}

TEST(Stacking, RefusesImpossibleScenes) {
  Witness witness;
  Deployment deployment("stacking_scenes");
  auto& high = deployment.Simulator({"--task", "stacking", "--tower", "5"});
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = high.Wait(0)) >= 0; }, 20000));
  EXPECT_EQ(code, 2);

  deployment.Simulator(kStacking);
  ASSERT_TRUE(witness.Until([&] { return SimulatorShows(witness); }, 20000));
  const std::int64_t before = witness.episode_id;
  sim_command_t reset{};
  reset.sender_id = 77;
  reset.command_id = 1;
  reset.kind = sim_command_t::KIND_RESET;
  reset.present_episode_id = before;
  reset.seed = 1;
  reset.episode_id = 4711;
  reset.legs = 10;  // no tower takes ten actions
  witness.Until([] { return false; }, 700, [&] { witness.bus.Publish(reset); });
  EXPECT_EQ(witness.episode_id, before);

  reset.command_id = 2;
  reset.legs = 18;  // a tower of three
  const auto again = [&] { witness.bus.Publish(reset); };
  EXPECT_TRUE(witness.Until([&] { return witness.episode_id == 4711; }, 10000, again))
      << "the refused one left the simulator as it was";
}

}  // namespace
}  // namespace prospect::tests

// Whole episodes of the real programs, in several start orders, judged by what the bus said and by
// result.json.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

constexpr int kEpisodeMs = 60000;

std::string OutcomeOf(const label_t& last, std::size_t acts) {
  if (last.outcome == label_t::OUTCOME_SUCCESS) return "solved";
  if (last.outcome == label_t::OUTCOME_FAILURE) return "failed";
  return acts == 0 ? "refused" : "stopped";
}

int ExitOf(const std::string& outcome) {
  if (outcome == "solved") return 0;
  return outcome == "refused" ? 3 : 4;
}

// The world's own account of the episode, the executive's and the exit status must be one story.
void ExpectOneStory(Witness& witness, const Deployment& deployment, int exit_code) {
  const auto result = deployment.Result();
  ASSERT_FALSE(witness.labels.empty());
  const label_t& last = witness.labels.rbegin()->second;
  const auto& acts = result.at("acts");
  EXPECT_EQ(result.at("outcome"), OutcomeOf(last, acts.size()));
  EXPECT_EQ(exit_code, ExitOf(result.at("outcome")));
  EXPECT_EQ(result.at("exit_code"), exit_code);
  EXPECT_EQ(last.segment + 1, static_cast<int>(acts.size()));
  ASSERT_FALSE(acts.empty()) << "the scripted engine should find something to do";
  EXPECT_EQ(last.action, acts.back().at("action").get<int>());
  ASSERT_FALSE(witness.plans.empty());
  EXPECT_EQ(witness.plans.front().decision, plan_t::DECISION_ACT);
  EXPECT_EQ(witness.plans.front().steps.at(0).action, acts.front().at("action").get<int>());
  for (const auto& search : result.at("searches")) {
    EXPECT_GE(search.at("rollouts").get<int>(), search.at("ended_by") == "samples" ? 150 : 1);
    EXPECT_TRUE(search.at("converged").get<bool>());
  }
}

TEST(Episode, ServicesFirst) {
  Witness witness;
  Deployment deployment("services_first");
  ASSERT_TRUE(deployment.Up(witness, 2));
  auto& executive = deployment.Executive({"--workers", "2"});
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, kEpisodeMs));
  witness.Listen(700);
  ExpectOneStory(witness, deployment, code);
  const std::string said = deployment.Log("5-prospect-executive");
  EXPECT_LT(said.find("1/3 investigate("), said.find("Step  Action"))
      << "a line an action, then the table: " << said;
  EXPECT_EQ(said.find("search 1:"), std::string::npos) << "searches are told with --verbose";
  EXPECT_FALSE(ReadText(deployment.folder + "/out/plan.png").empty());
  EXPECT_FALSE(ReadText(deployment.folder + "/out/episode.mp4").empty());
}

TEST(Episode, ExecutiveFirst) {
  Witness witness;
  Deployment deployment("executive_first");
  auto& executive = deployment.Executive({"--workers", "2"});
  ASSERT_TRUE(witness.Until([&] { return witness.Ready("executive", 1); }, 10000));
  ASSERT_TRUE(deployment.Up(witness, 2));
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, kEpisodeMs));
  witness.Listen(700);
  ExpectOneStory(witness, deployment, code);
}

// The second worker arrives when the episode already runs.
TEST(Episode, WorkersFirstAndOneLate) {
  Witness witness;
  Deployment deployment("workers_first");
  deployment.Worker();
  deployment.ModelServer();
  ASSERT_TRUE(witness.Until([&] { return witness.Ready("worker", 1) && witness.Ready("model", 1); },
                            10000));
  deployment.Simulator();
  auto& executive = deployment.Executive();
  ASSERT_TRUE(witness.Until([&] { return !witness.roots.empty(); }, 20000));
  deployment.Worker();
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, kEpisodeMs));
  witness.Listen(700);
  ExpectOneStory(witness, deployment, code);
}

TEST(Episode, TwoServersSideBySide) {
  Witness witness;
  Deployment deployment("two_servers");
  deployment.ModelServer();
  ASSERT_TRUE(deployment.Up(witness, 1));
  ASSERT_TRUE(witness.Until([&] { return witness.Ready("model", 2); }, 10000));
  auto& executive = deployment.Executive();
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, kEpisodeMs));
  witness.Listen(700);
  ExpectOneStory(witness, deployment, code);
  std::set<std::int64_t> servers;
  for (const auto& reply : witness.replies) {
    if (!reply.evaluations.empty()) servers.insert(reply.server_id);
  }
  EXPECT_EQ(servers.size(), 2u) << "the paths should be spread over both servers";
}

TEST(Episode, MissingServicesAreNamed) {
  Witness witness;
  Deployment deployment("missing");
  deployment.Simulator();
  auto& executive = deployment.Executive({"--services-timeout-ms", "1500"});
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 15000));
  EXPECT_EQ(code, 15);
  const std::string log = deployment.Log("2-prospect-executive");
  EXPECT_NE(log.find("model server"), std::string::npos) << log;
  EXPECT_NE(log.find("planner workers"), std::string::npos) << log;
}

TEST(Episode, RefusalSendsNoAction) {
  Witness witness;
  Deployment deployment("refusal");
  ASSERT_TRUE(deployment.Up(witness, 2));
  auto& executive = deployment.Executive({"--refusal-threshold", "1"});
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, kEpisodeMs));
  witness.Listen(500);
  EXPECT_EQ(code, 3);
  EXPECT_EQ(deployment.Result().at("outcome"), "refused");
  EXPECT_TRUE(deployment.Result().at("actions").empty());
  EXPECT_TRUE(witness.commands.empty());
  ASSERT_FALSE(witness.plans.empty());
  EXPECT_EQ(witness.plans.back().decision, plan_t::DECISION_REFUSE);
  EXPECT_FALSE(witness.plans.back().reason.empty());
  EXPECT_EQ(witness.labels.rbegin()->first, 0) << "the world should have held still";
}

// Pictures of an episode that is over, which are late or said again, are none of the next one's,
// though that is of the same seed.
TEST(Episode, AnOldPictureOfTheSameSceneIsNotTaken) {
  Witness witness;
  observation_t picture{};
  const auto subscription =
      witness.bus.Subscribe<observation_t>([&](const observation_t& seen) { picture = seen; });
  Deployment deployment("old_picture");
  deployment.Simulator();
  auto& first = deployment.Executive({"--policy", "plan:0,1,2"});
  int code = -1;
  ASSERT_TRUE(witness.Until([&] { return (code = first.Wait(0)) >= 0; }, kEpisodeMs));
  ASSERT_TRUE(code == 0 || code == 4) << code;
  ASSERT_GT(picture.frame, 0);
  const observation_t old = picture;
  const label_t old_label = witness.labels.rbegin()->second;
  const action_status_t old_status = witness.statuses.back();
  const std::size_t commands = witness.commands.size();

  auto& second = deployment.Executive({"--policy", "plan:0,1,2"});
  const auto repeat = [&] {
    witness.bus.Publish(old_label);
    witness.bus.Publish(old);
    witness.bus.Publish(old_status);
  };
  const int first_code = code;
  ASSERT_TRUE(witness.Until([&] { return (code = second.Wait(0)) >= 0; }, kEpisodeMs, repeat));
  EXPECT_EQ(code, first_code) << deployment.Log("3-prospect-executive");
  ASSERT_GT(witness.commands.size(), commands);
  EXPECT_NE(witness.commands.back().episode_id, old.episode_id) << "a reset is another episode";
  EXPECT_EQ(deployment.Result().at("seed"), 1500000);
}

}  // namespace
}  // namespace prospect::tests

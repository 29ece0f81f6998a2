// Goals of the command line on their way over the bus: what is planned, what is refused and how.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "services/common/health.h"
#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

using Names = std::vector<std::string>;

constexpr int kEpisodeMs = 60000;

int EndOf(Witness& witness, Process& process) {
  int code = -1;
  witness.Until([&] { return (code = process.Wait(0)) >= 0; }, kEpisodeMs);
  return code;
}

bool Has(const Names& names, const std::string& name) {
  return std::count(names.begin(), names.end(), name) > 0;
}

// Each search of the episode asks for the goal, and each plan, with what was done before it, has
// it.
TEST(Goals, PlansVisitWhatWasAskedFor) {
  Witness witness;
  Deployment deployment("goal_visits");
  ASSERT_TRUE(deployment.Up(witness, 2));
  std::set<Names> first_plans;
  for (const auto& [one, other] : {std::pair<const char*, const char*>{"barrel", "pylon"},
                                   std::pair<const char*, const char*>{"pylon", "barricade"}}) {
    witness.roots.clear();
    const std::string goal = std::string("visited(") + one + "," + other + ")";
    const int code = EndOf(witness, deployment.Executive({"--workers", "2", "--goal", goal}));
    const auto result = deployment.Result();
    EXPECT_EQ(result.at("exit_code"), code);
    const Names atoms = {std::string("visited(") + one + ")",
                         std::string("visited(") + other + ")"};
    EXPECT_EQ(result.at("goal").get<Names>(), atoms);
    ASSERT_FALSE(witness.roots.empty());
    for (const auto& root : witness.roots) {
      ASSERT_EQ(root.goals.size(), 2u);
      for (std::size_t i = 0; i < 2; ++i)  // and which action brings it about
        EXPECT_TRUE(root.goals[i].starts_with(atoms[i] + "=")) << root.goals[i];
    }
    const auto& searches = result.at("searches");
    ASSERT_FALSE(searches.empty());
    const auto acts = result.at("actions").get<Names>();
    for (std::size_t i = 0; i < searches.size(); ++i) {
      if (searches[i].at("decision") != "act") continue;
      Names plan(acts.begin(), acts.begin() + static_cast<std::ptrdiff_t>(i));
      for (const auto& name : searches[i].at("plan")) plan.push_back(name);
      EXPECT_EQ(plan.size(), 3u);
      for (const char* object : {one, other})
        EXPECT_TRUE(Has(plan, std::string("investigate(") + object + ")")) << object << ' ' << i;
      if (i == 0) first_plans.insert(plan);
    }
    EXPECT_TRUE(code != 0 || acts.size() == 3u);
  }
  EXPECT_EQ(first_plans.size(), 2u) << "the scripted engine should find something to do";
}

TEST(Goals, ImpossibleOnesAreRefusedBeforeAnythingIsSearched) {
  Witness witness;
  Deployment deployment("goal_impossible");
  ASSERT_TRUE(deployment.Up(witness, 1));
  const auto expect_refusal = [&](const Names& arguments, const std::string& why) {
    const int code = EndOf(witness, deployment.Executive(arguments));
    EXPECT_EQ(code, 3) << why;
    const auto result = deployment.Result();
    EXPECT_EQ(result.at("outcome"), "refused");
    EXPECT_EQ(result.at("exit_code"), 3);
    const std::string reason = result.at("reason");
    EXPECT_NE(reason.find("the goal cannot be brought about: " + why), std::string::npos) << reason;
    EXPECT_TRUE(result.at("actions").empty());
  };
  expect_refusal({"--goal", "visited(unicorn)"}, "there is no 'unicorn' in this task");
  expect_refusal({"--goal", "on(barrel,pylon)"}, "this task has no goal 'on'");
  expect_refusal({"--goal", "visited(barrel,pylon,barricade,block)"},
                 "no plan of this task's 3 actions");
  // Four of the seven objects stand on this site.
  expect_refusal({"--goal", "visited(unicorn)", "--objects", "4"}, "there is no 'unicorn'");
  ASSERT_TRUE(witness.Until(
      [&] {
        const auto& present = witness.labels.rbegin()->second.present;
        return std::count(present.begin(), present.end(), 1) == 4;
      },
      10000));
  const auto& present = witness.labels.rbegin()->second.present;
  const auto absent = std::find(present.begin(), present.end(), 0) - present.begin();
  const Names objects = {"barrel", "barricade", "pylon", "block", "spool", "generator", "cabin"};
  const std::string& missing = objects[static_cast<std::size_t>(absent)];
  expect_refusal({"--goal", "visited(" + missing + ")", "--objects", "4"},
                 "there is no " + missing + " in this scene");
  EXPECT_TRUE(witness.roots.empty());
  EXPECT_TRUE(witness.commands.empty());
}

// Plans given by hand leave the goal out: those that the simulator calls a success are none.
TEST(Goals, SuccessWithoutTheGoalIsAFailure) {
  Witness witness;
  Deployment deployment("goal_missed");
  deployment.Simulator();
  ASSERT_TRUE(witness.Until([&] { return witness.Ready("simulator", 1); }, 10000));
  int successes = 0;
  for (const char* plan : {"plan:0,1,2", "plan:2,3,1", "plan:4,0,3", "plan:5,2,4", "plan:1,4,5",
                           "plan:3,5,0", "plan:4,2,1", "plan:5,3,1"}) {
    witness.labels.clear();
    EXPECT_EQ(EndOf(witness, deployment.Executive({"--policy", plan, "--goal", "visited(cabin)"})),
              4);
    const auto result = deployment.Result();
    EXPECT_EQ(result.at("outcome"), "failed");
    if (result.at("reason") != "goal not reached") continue;
    EXPECT_EQ(result.at("actions").size(), 3u);
    EXPECT_TRUE(witness.Until(
        [&] {
          return !witness.labels.empty() &&
                 witness.labels.rbegin()->second.outcome == label_t::OUTCOME_SUCCESS;
        },
        10000));
    if (++successes == 2) return;
  }
  EXPECT_GT(successes, 0) << "take another seed, at which one of the plans succeeds";
}

TEST(Goals, MalformedOnesAreUsageErrors) {
  Witness witness;
  Deployment deployment("goal_malformed");
  int started = 0;
  for (const char* goal : {"visited(barrel", "red on blue", ""}) {
    EXPECT_EQ(EndOf(witness, deployment.Executive({"--goal", goal})), 2) << goal;
    const std::string log = deployment.Log(std::to_string(++started) + "-prospect-executive");
    EXPECT_NE(log.find("is no goal"), std::string::npos) << log;
    EXPECT_NE(log.find("on(A,B)"), std::string::npos) << log;
  }
  EXPECT_TRUE(ReadText(deployment.folder + "/out/result.json").empty());
}

std::int64_t Refused(const Witness& witness) {
  for (const auto& worker : witness.Services("worker")) {
    for (const auto& counter : worker.counters) {
      if (counter.name == "SEARCH_ROOT: goals") return counter.value;
    }
  }
  return 0;
}

TEST(Goals, WorkersRefuseNonsenseAndGoOn) {
  Witness witness;
  Deployment deployment("goal_nonsense");
  ASSERT_TRUE(deployment.Up(witness, 1));
  EXPECT_GE(EndOf(witness, deployment.Executive()), 0);
  ASSERT_FALSE(witness.roots.empty());
  search_root_t root = witness.roots.back();
  const std::vector<Names> nonsense = {{"visited(unicorn)"},
                                       {"on(barrel,pylon)"},
                                       {""},
                                       {"visited(barrel", "pylon)"},
                                       {"\xff\x01(*)"},
                                       {std::string(20000, '(')},
                                       Names(3000, "visited(barrel)visited(x)")};
  std::int64_t refused = 0;
  for (const Names& goals : nonsense) {
    ++root.search_id;
    root.goals = goals;
    root.num_goals = static_cast<std::int32_t>(goals.size());
    ++refused;
    EXPECT_TRUE(witness.Until([&] { return Refused(witness) == refused; }, 10000,
                              [&] { witness.bus.Publish(root); }))
        << Refused(witness) << " of " << refused;
  }
  const auto before = witness.Services("worker").at(0).instance_id;
  EXPECT_GE(EndOf(witness, deployment.Executive({"--goal", "visited(barrel)"})), 0);
  EXPECT_FALSE(deployment.Result().at("searches").empty());
  ASSERT_EQ(witness.Services("worker").size(), 1u);
  EXPECT_EQ(witness.Services("worker")[0].instance_id, before) << "it is still the same worker";
}

}  // namespace
}  // namespace prospect::tests

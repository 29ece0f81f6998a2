#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "lcmtypes/checked_codec.h"
#include "lcmtypes/validate.h"
#include "services/binding/calibration_messages.h"
#include "services/binding/evaluation_messages.h"
#include "services/binding/novelty_messages.h"
#include "services/binding/search_messages.h"
#include "services/binding/statistics_messages.h"
#include "services/binding/task_messages.h"

namespace prospect::services {
namespace {

planner::Evaluation SomeEvaluation() {
  planner::Evaluation evaluation;
  evaluation.value = 0.123456f;
  evaluation.done = 0.98765f;
  evaluation.q = {0.1f, 0.2f, 0.3f, 0.4f};
  evaluation.p = {0.9f, 0.8f, 0.7f, 0.6f};
  return evaluation;
}

TEST(EvaluationMessages, AllowedActionsComeBackWithinTheGridAndOthersAsZero) {
  const auto back = FromMessage(ToMessage({2}, SomeEvaluation(), {0, 3}), 4);
  EXPECT_NEAR(back.value, 0.123456f, 1.0 / 65535);
  EXPECT_NEAR(back.done, 0.98765f, 1.0 / 65535);
  EXPECT_NEAR(back.q[3], 0.4f, 1.0 / 65535);
  EXPECT_NEAR(back.p[0], 0.9f, 1.0 / 65535);
  EXPECT_EQ(back.q[1], 0.0f);
  EXPECT_EQ(back.p[2], 0.0f);
}

TEST(CalibrationMessages, ComeBackWithEveryScene) {
  model::CalibrationSample sample;
  sample.rule = "paper";
  sample.parameters = {{"samples", 30}, {"v_failed", 0.02}};
  sample.scenes = {{0, model::SceneClass::kHopeless, model::SceneEnding::kRefused},
                   {0.25, model::SceneClass::kSolvable, model::SceneEnding::kStopped},
                   {0.875, model::SceneClass::kDoubtful, model::SceneEnding::kFailed}};
  calibration_t message{};
  SetSample(sample, &message);
  SetSample(sample, &message);  // what was there before does not stay
  EXPECT_EQ(message.num_scenes, 3);
  EXPECT_EQ(message.num_parameters, 2);
  const model::CalibrationSample back = SampleFrom(message);
  EXPECT_EQ(back.rule, sample.rule);
  EXPECT_EQ(back.parameters, sample.parameters);
  ASSERT_EQ(back.scenes.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(back.scenes[i].score, sample.scenes[i].score);
    EXPECT_EQ(back.scenes[i].scene_class, sample.scenes[i].scene_class);
    EXPECT_EQ(back.scenes[i].ending, sample.scenes[i].ending);
  }
}

// What went over the wire once is not changed by going over it again: all processes see the same
// numbers.
TEST(EvaluationMessages, SecondTripChangesNothing) {
  const auto once = ToMessage({}, SomeEvaluation(), {0, 1, 2, 3});
  const auto twice = ToMessage({}, FromMessage(once, 4), {0, 1, 2, 3});
  EXPECT_EQ(once.value, twice.value);
  EXPECT_EQ(once.done, twice.done);
  EXPECT_EQ(once.q, twice.q);
  EXPECT_EQ(once.p, twice.p);
}

// The longest plan of the largest table: what a task may be, messages and their checks bear.
TEST(EvaluationMessages, TheLargestTaskFits) {
  const planner::Path path(planner::kMaxPathLength, 254);
  planner::Evaluation evaluation;
  evaluation.q.assign(255, 0.25F);
  evaluation.p.assign(255, 0.75F);
  std::vector<int> all(255);
  std::iota(all.begin(), all.end(), 0);
  expand_reply_t reply{};
  reply.status = expand_reply_t::STATUS_OK;
  reply.evaluations = {ToMessage(path, evaluation, all)};
  reply.num_evaluations = 1;
  EXPECT_EQ(messages::Validate(reply), "");
  const auto bytes = messages::CheckedEncode(reply);
  EXPECT_LT(bytes.size(), 1600U) << "so forty go into one datagram";
  const auto back = messages::CheckedDecode<expand_reply_t>(bytes.data(), bytes.size());
  ASSERT_TRUE(back.ok()) << back.reason;
  EXPECT_EQ(back.value.evaluations.at(0).path.actions, path);
  EXPECT_NEAR(FromMessage(back.value.evaluations[0], 255).p[254], 0.75F, 1.0 / 65535);
}

TEST(EvaluationMessages, ActionsBeyondTheTableAreLeftOut) {
  const auto message = ToMessage({}, SomeEvaluation(), {0, 1, 2, 3});
  EXPECT_EQ(FromMessage(message, 2).q.size(), 2u);
}

TEST(StatisticsMessages, KeepTheChecksum) {
  planner::StatisticsBatch batch;
  batch.search = {0xfedcba9876543210ULL, 7};
  batch.writer = 11;
  batch.sequence = 3;
  batch.totals = {5, 4, 2, 1, 0x8000000000000001ULL, true, 9, 3};
  batch.rows.push_back({11, {1, 2}, 3, 5, planner::kValueOne / 3, 0.75f, 2});
  batch.checksum = planner::PayloadChecksum(batch);
  const auto back = FromMessage(ToMessage(batch, 1000));
  EXPECT_EQ(planner::PayloadChecksum(back), batch.checksum);
  EXPECT_EQ(back.checksum, batch.checksum);
  EXPECT_TRUE(back.totals.finished);
}

TEST(SearchMessages, ParametersComeBack) {
  planner::SearchParameters sent;
  sent.rule = "puct";
  sent.c = 3.5;
  sent.p_min = 0.05;
  sent.refusal_threshold = 0.4;
  sent.sharing = false;
  sent.workers = 4;
  sent.depth = 4;
  sent.samples = 77;
  sent.seed = 5;
  search_root_t root{};
  SetParameters(sent, &root);
  root.budget_ms = -1;
  const auto back = ParametersFrom(root, 1000);
  EXPECT_EQ(back.rule, "puct");
  EXPECT_EQ(back.c, 3.5);
  EXPECT_EQ(back.p_min, 0.05);
  EXPECT_EQ(back.refusal_threshold, 0.4);
  EXPECT_FALSE(back.sharing);
  EXPECT_EQ(back.workers, 4);
  EXPECT_EQ(back.depth, 4);
  EXPECT_EQ(back.samples, 77);
  EXPECT_EQ(back.deadline_us, 0);
  root.budget_ms = 50;
  EXPECT_EQ(ParametersFrom(root, 1000).deadline_us, 51000);
}

task_t SmallTask() {
  task_t task{};
  task.name = "t";
  for (int i = 0; i < 2; ++i) {
    action_t action{};
    action.index = i;
    action.name = "a" + std::to_string(i);
    action.successors = {1 - i};
    action.num_successors = 1;
    task.actions.push_back(action);
  }
  task.num_actions = 2;
  task.initial = {0, 1};
  task.num_initial = 2;
  task.plan_length = 2;
  return task;
}

TEST(TaskMessages, RulesFollowTheTable) {
  const auto rules = RulesFromTask(SmallTask());
  EXPECT_EQ(rules.AllowedActions({}, {}), (std::vector<int>{0, 1}));
  EXPECT_EQ(rules.AllowedActions({}, {1}), (std::vector<int>{0}));
  EXPECT_TRUE(rules.Complete({1}, {0}));
}

search_root_t RootWith(const std::vector<std::string>& goals, int plan_length = 2) {
  search_root_t root{};
  root.goals = goals;
  root.num_goals = static_cast<std::int32_t>(goals.size());
  root.plan_length = plan_length;
  return root;
}

TEST(TaskMessages, TheGoalOfASearchNarrowsItsRules) {
  task_t task = SmallTask();
  task.initial = {0};
  task.plan_length = 1;
  for (auto& action : task.actions) action.kind = "investigate";
  task.actions[0].object = "barrel";
  task.actions[1].object = "pylon";
  EXPECT_EQ(RulesOfSearch(task, RootWith({}, 1)).AllowedActions({}, {}), (std::vector<int>{0}));
  EXPECT_TRUE(RulesOfSearch(task, RootWith({}, 1)).finishes.empty()) << "as the task's own";
  task.initial = {0, 1};
  EXPECT_EQ(RulesOfSearch(task, RootWith({"visited(pylon)=1"}, 1)).AllowedActions({}, {}),
            (std::vector<int>{1}));
  task.plan_length = 2;
  const auto both = RulesOfSearch(task, RootWith({"visited(pylon)=1", "visited(barrel)=0"}));
  EXPECT_EQ(both.AllowedActions({}, {}), (std::vector<int>{0, 1}));
  EXPECT_TRUE(both.GoalMet({1}, {0}));
}

// A plan that was begun anew is longer than any that the task itself has.
TEST(TaskMessages, AGoalHoldsForPlansBegunAnewToo) {
  task_t task{};
  for (int i = 0; i < 4; ++i) {
    action_t action{};
    action.index = i;
    action.name = "a" + std::to_string(i);
    action.kind = "investigate";
    action.object = action.name;
    task.actions.push_back(action);
  }
  task.actions[0].successors = {1};
  task.actions[1].successors = {0, 2};  // begin anew, or go on
  task.actions[2].successors = {3};
  task.actions[3].successors = {0};
  task.initial = {0};
  task.plan_length = 4;
  task.repeats_allowed = 1;
  task.num_actions = 4;
  const search_root_t root = RootWith({"visited(a3)=3"}, 5);
  const auto rules = RulesOfSearch(task, root);
  EXPECT_TRUE(rules.AllowedActions({}, {}).empty()) << "no plan of five begins at the beginning";
  EXPECT_EQ(rules.AllowedActions({1}, {}), (std::vector<int>{0}));
  EXPECT_TRUE(rules.Legal({1}, {0, 1, 2, 3}));
  EXPECT_EQ(NamesOf(task, {1, 0, 9}), "a1, a0, action 9");
}

TEST(TaskMessages, NonsenseGoalsAreRefused) {
  const task_t task = SmallTask();
  for (const char* goal : {"", "visited(", "on(a,b)", "visited(nobody)=99", "\xff\x01", "on(*,*)="})
    EXPECT_THROW(RulesOfSearch(task, RootWith({goal})), planner::GoalError) << goal;
  EXPECT_THROW(RulesOfSearch(task, RootWith(std::vector<std::string>(10000, "visited(a)=0"))),
               planner::GoalError);
}

// Recordings and model servers of other builds know a task by it.
TEST(TaskMessages, HashIsFixed) {
  task_t task{};
  task.name = "golden";
  task.world_version = "1";
  EXPECT_EQ(TaskHash(task), 0x405aabca352b4e8a);
}

TEST(TaskMessages, HashTellsPlanLengthsApartAndNotTimes) {
  task_t task = SmallTask();
  const auto hash = TaskHash(task);
  task.utime = 99;
  task.task_hash = 5;
  EXPECT_EQ(TaskHash(task), hash);
  task.plan_length = 1;
  EXPECT_NE(TaskHash(task), hash);
}

TEST(TaskMessages, IndexOutsideTheTableIsRefused) {
  task_t task = SmallTask();
  task.initial = {0, 9};
  EXPECT_THROW(RulesFromTask(task), std::runtime_error);
}

TEST(NoveltyMessages, ComeBackAsTheyWent) {
  const model::Novelty sent{0.002, 0.051, 0.02, 3.25, 1.2, 1.0, 1.3};
  const model::Novelty back = FromMessage(ToMessage(sent));
  EXPECT_EQ(back.p, sent.p);
  EXPECT_EQ(back.error, sent.error);
  EXPECT_EQ(back.error_limit, sent.error_limit);
  EXPECT_EQ(back.residual, sent.residual);
  EXPECT_EQ(back.residual_limit, sent.residual_limit);
  EXPECT_EQ(back.state, sent.state);
  EXPECT_EQ(back.state_limit, sent.state_limit);
}

}  // namespace
}  // namespace prospect::services

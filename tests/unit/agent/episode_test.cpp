// Every way in which an episode can end, with a world and a mind that do as their script says.

#include "agent/episode.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "agent/errors.h"
#include "tests/unit/agent/calibration_sample.h"
#include "tests/unit/agent/scripted.h"

namespace prospect::agent {
namespace {

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Keeps what is told.
class Told : public Listener {
 public:
  void Tell(const std::string& line) override { lines.push_back(line); }
  void Warn(const std::string& line) override { warnings.push_back(line); }
  void PlanChanged(const EpisodeRecord&) override { ++plans; }

  std::vector<std::string> lines, warnings;
  int plans = 0;
};

class EpisodeTest : public ::testing::Test {
 protected:
  EpisodeTest() { options_.novelty = 0; }

  Episode Make() { return Episode(world_, &mind_, options_, told_); }
  EpisodeRecord Run() { return Make().Run(); }

  // Plans that go on with one another: the whole one, and what is left after each action.
  void Finds(const planner::Path& plan, double score = 0.9) {
    for (std::size_t i = 0; i < plan.size(); ++i)
      mind_.plans.push_back(
          PlanOf({plan.begin() + static_cast<std::ptrdiff_t>(i), plan.end()}, score));
  }

  void ExpectRefused(const EpisodeRecord& record, const std::string& why) {
    EXPECT_EQ(record.outcome, "refused");
    EXPECT_TRUE(Holds(record.reason, why)) << record.reason;
    EXPECT_TRUE(record.acts.empty());
    EXPECT_TRUE(world_.carried_out.empty());
  }

  Script script_;
  ScriptedWorld world_{script_};
  ScriptedMind mind_{script_};
  EpisodeOptions options_;
  Told told_;
};

TEST_F(EpisodeTest, SearchesByTheRuleOfTheCalibrationUnlessAskedForAnother) {
  const auto rule_of_search = [this](const std::string& asked, const std::string& calibrated) {
    options_.search = planner::SearchParameters();
    options_.search.rule = asked;
    mind_.calibrations.clear();
    if (!calibrated.empty()) mind_.calibrations = {Sample(), Of(9)};
    if (!calibrated.empty()) mind_.calibrations.front().rule = calibrated;
    mind_.questions.clear();
    Run();
    return mind_.questions.at(0).parameters;
  };
  EXPECT_EQ(rule_of_search("", "best_first").rule, "best_first");
  EXPECT_EQ(rule_of_search("", "best_first").v_failed, 0) << "its cuts, too";
  EXPECT_EQ(rule_of_search("puct", "best_first").rule, "puct");
  EXPECT_EQ(rule_of_search("", "").rule, planner::SearchParameters().rule);
}

TEST_F(EpisodeTest, IsSolvedWhenTheWorldSaysSo) {
  Finds({2, 0, 1});
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "solved");
  EXPECT_EQ(record.reason, "");
  EXPECT_EQ(world_.carried_out, (std::vector<int>{2, 0, 1}));
  EXPECT_EQ(script_.Text(),
            "await begin choose calibration search carry_out(2) look "
            "search carry_out(0) look search carry_out(1) look");
  EXPECT_EQ(told_.lines,
            (std::vector<std::string>{"1/3 visit(rock): succeeded", "2/3 visit(barrel): succeeded",
                                      "3/3 visit(pylon): succeeded"}));
  EXPECT_EQ(told_.plans, 6) << "after each search and each action";
  EXPECT_EQ(record.task, "visits");
  EXPECT_EQ(record.seed, 7);
  EXPECT_EQ(record.objects, 4);
  EXPECT_EQ(record.plan_length, 3);
  EXPECT_EQ(record.weights, "00000000000000aa");
  EXPECT_EQ(record.searches.size(), 3u);
  EXPECT_EQ(record.rollouts, 90);
  EXPECT_EQ(record.evaluations, 60);
  EXPECT_DOUBLE_EQ(record.acts[1].sim_seconds, 1);
  EXPECT_EQ(record.frames.size(), 1u);
}

TEST_F(EpisodeTest, AsksEachSearchForWhatRemains) {
  options_.search.samples = 12;
  Finds({2, 0, 1});
  Run();
  ASSERT_EQ(mind_.questions.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const SearchQuestion& question = mind_.questions[i];
    EXPECT_EQ(question.executed.size(), i);
    EXPECT_EQ(question.parameters.depth, static_cast<int>(3 - i));
    EXPECT_EQ(question.parameters.samples, 12);
    EXPECT_EQ(question.parameters.refusal_threshold, 0.25) << "the weights' own";
    EXPECT_EQ(question.rules.plan_length, 3);
    EXPECT_EQ(question.first.frame, 0);
    EXPECT_EQ(question.present.frame, static_cast<std::int64_t>(i));
  }
}

TEST_F(EpisodeTest, IsSolvedWhereNobodyJudgesWhenThePlanIsCarriedOut) {
  Finds({2, 0, 1});
  world_.results.assign(3, {ActionState::kSucceeded, TrialOutcome::kUnknown, ""});
  EXPECT_EQ(Run().outcome, "solved");
}

TEST_F(EpisodeTest, IsStoppedWhereThePlanIsOverAndTheTaskIsNot) {
  Finds({2, 0, 1});
  world_.results.assign(3, {});
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "stopped");
  EXPECT_EQ(record.reason, "the plan was carried out and the task is not complete");
}

TEST_F(EpisodeTest, ARefusalOfTheFirstSearchDoesNothing) {
  mind_.plans = {Refusal("every future fails")};
  ExpectRefused(Run(), "every future fails");
  EXPECT_EQ(told_.plans, 1);
}

TEST_F(EpisodeTest, ARefusalAfterTheFirstActionStops) {
  mind_.plans = {PlanOf({2, 0, 1}), Refusal("hopeless now")};
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "stopped");
  EXPECT_EQ(record.reason, "hopeless now");
  EXPECT_EQ(record.acts.size(), 1u);
}

TEST_F(EpisodeTest, AForeignPictureIsRefusedWhateverTheSearchFound) {
  options_.novelty = 0.01;
  Finds({2, 0, 1});
  mind_.recognition.novelty = model::Novelty{0.002, 0.051, 0.02, 3.25, 1.2, 1.0, 1.3};
  const EpisodeRecord record = Run();
  ExpectRefused(record, "this picture is unlike what the networks were trained on");
  EXPECT_FALSE(record.searches.at(0).act);
  ASSERT_TRUE(record.familiarity);
  EXPECT_TRUE(record.familiarity->foreign());
  EXPECT_FALSE(record.confidence) << "of a plan that is not to be carried out";
}

TEST_F(EpisodeTest, AKnownPictureIsAskedForOnce) {
  options_.novelty = 0.01;
  Finds({2, 0, 1});
  mind_.recognition.novelty = model::Novelty{0.4, 0.01, 0.02, 1, 1.2, 1, 1.3};
  EXPECT_EQ(Run().outcome, "solved");
  EXPECT_EQ(std::count(script_.calls.begin(), script_.calls.end(), "familiar"), 1);
}

TEST_F(EpisodeTest, ASafeguardThatCannotBeAskedDoesNotPass) {
  options_.novelty = 0.01;
  Finds({2, 0, 1});
  mind_.recognition.defect = "no server answered within 3 s";
  ExpectRefused(Run(), "nobody could say whether the picture is like those");
}

TEST_F(EpisodeTest, WhereNothingIsKnownOfPicturesNoneIsRefused) {
  options_.novelty = 0.01;
  Finds({2, 0, 1});
  EXPECT_EQ(Run().outcome, "solved");
}

TEST_F(EpisodeTest, AGoalThatTheTaskCannotHaveIsRefusedBeforeAnySearch) {
  options_.goal = "on(barrel,pylon)";
  ExpectRefused(Run(), "the goal cannot be brought about: ");
  EXPECT_TRUE(mind_.questions.empty());
}

TEST_F(EpisodeTest, AGoalThatTheSceneCannotHaveIsRefusedBeforeAnySearch) {
  options_.goal = "visited(tree)";
  options_.explain = true;
  world_.scene->present[3] = false;
  const EpisodeRecord record = Run();
  ExpectRefused(record, "there is no tree in this scene; there are: barrel, pylon, rock");
  EXPECT_TRUE(mind_.questions.empty());
  ASSERT_TRUE(record.explanation);
  EXPECT_EQ(record.explanation->reason, record.reason);
  EXPECT_EQ(record.explanation->task, "visits");
}

TEST_F(EpisodeTest, AGoalIsJudgedByWhatWasCarriedOut) {
  options_.goal = "visited(tree)";
  Finds({3, 0, 1});
  EXPECT_EQ(Run().outcome, "solved");
  EXPECT_EQ(mind_.questions.at(0).goal, (std::vector<std::string>{"visited(tree)=3"}));
  EXPECT_EQ(mind_.questions.at(2).rules.AllowedActions({0, 1}, {}), (std::vector<int>{3}));
}

TEST_F(EpisodeTest, SuccessWithoutTheGoalIsAFailure) {
  options_.goal = "visited(tree)";
  Finds({2, 0, 1});  // a mind that does not heed the goal
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "failed");
  EXPECT_EQ(record.reason, "goal not reached");
}

TEST_F(EpisodeTest, MalformedGoalsAreThrown) {
  options_.goal = "visited(";
  EXPECT_THROW(Make(), std::invalid_argument);
}

TEST_F(EpisodeTest, APromiseThatNoThresholdKeepsIsRefusedBeforeAnySearch) {
  options_.promise.fail_at_most = 0.001;
  mind_.calibrations = {Sample()};
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "refused");
  EXPECT_FALSE(record.reason.empty());
  EXPECT_TRUE(mind_.questions.empty());
  ASSERT_TRUE(record.terms);
  EXPECT_EQ(record.terms->promises.back(), record.reason);
  EXPECT_FALSE(record.terms->table.empty()) << "what could be had";
}

TEST_F(EpisodeTest, APromiseSetsTheThreshold) {
  options_.promise.refuse_at_most = 0.5;
  mind_.calibrations = {Sample()};
  Finds({2, 0, 1});
  const EpisodeRecord record = Run();
  EXPECT_GT(mind_.questions.at(0).parameters.refusal_threshold, 0.25);
  EXPECT_EQ(record.searches.at(0).threshold, mind_.questions.at(0).parameters.refusal_threshold);
  ASSERT_TRUE(record.terms);
  EXPECT_FALSE(record.terms->promises.empty());
}

TEST_F(EpisodeTest, APromiseNeedsACalibrationThatCoversTheScene) {
  options_.promise.refuse_at_most = 0.1;
  EXPECT_THROW(Run(), Lost) << "there is none";
  mind_.calibrations = {Of(9)};
  EXPECT_THROW(Run(), PromiseError) << "of another kind of scenes";
  EXPECT_TRUE(mind_.questions.empty());
}

TEST_F(EpisodeTest, ScenesThatTheWeightsWereNotCalibratedOnAreRefused) {
  mind_.calibrations = {Of(9)};
  Finds({2, 0, 1});
  const EpisodeRecord record = Run();
  ExpectRefused(record, "--refusal-threshold X attempts plans");
  EXPECT_EQ(told_.warnings, (std::vector<std::string>{record.not_covered}));
  EXPECT_EQ(mind_.questions.at(0).parameters.refusal_threshold, 0) << "theirs does not hold";
  EXPECT_FALSE(record.terms);
}

TEST_F(EpisodeTest, EachKindOfScenesHasItsOwnCalibration) {
  mind_.calibrations = {Of(9), Of(3)};
  mind_.calibrations[0].refusal_threshold = 0.9;
  mind_.calibrations[0].rule = "puct";
  mind_.calibrations[1].refusal_threshold = 0.125;
  mind_.calibrations[1].rule = "best_first";
  options_.search.rule = "";
  Finds({2, 0, 1});
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "solved");
  EXPECT_EQ(record.not_covered, "");
  EXPECT_EQ(mind_.questions.at(0).parameters.refusal_threshold, 0.125);
  EXPECT_EQ(mind_.questions.at(0).parameters.rule, "best_first");
}

TEST_F(EpisodeTest, AThresholdOfOnesOwnAttemptsThemAllTheSame) {
  mind_.calibrations = {Of(9)};
  options_.refusal_threshold = 0.4;
  Finds({2, 0, 1});
  EXPECT_EQ(Run().outcome, "solved");
  EXPECT_EQ(mind_.questions.at(0).parameters.refusal_threshold, 0.4);
}

TEST_F(EpisodeTest, ConfidenceIsThatOfTheFirstPlan) {
  mind_.calibrations = {Sample()};
  Finds({2, 0, 1}, 0.84);
  const EpisodeRecord record = Run();
  ASSERT_TRUE(record.confidence);
  EXPECT_GE(record.confidence->share(), 0.8);
  ASSERT_TRUE(record.terms);
  EXPECT_EQ(record.terms->sample, 80);
}

TEST_F(EpisodeTest, AFailedActionEndsItWithTheCauseInWords) {
  Finds({2, 0, 1});
  world_.results = {{}, {ActionState::kFailed, TrialOutcome::kFailure, "time"}};
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "failed");
  EXPECT_EQ(record.reason, "visit(barrel) failed: it ran out of time");
  EXPECT_EQ(record.acts.back().reason, "time") << "by its name";
  EXPECT_EQ(told_.lines.back(), "2/3 visit(barrel): failed, it ran out of time");
}

TEST_F(EpisodeTest, ACauseOfARobotsOwnIsToldAsItIs) {
  Finds({2, 0, 1});
  world_.results = {{ActionState::kFailed, TrialOutcome::kUnknown, "collision(left foot)"}};
  EXPECT_EQ(Run().reason, "visit(rock) failed: collision(left foot)");
}

TEST_F(EpisodeTest, ACancelledActionStopsIt) {
  Finds({2, 0, 1});
  world_.results = {{ActionState::kCancelled, TrialOutcome::kRunning, ""}};
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "stopped");
  EXPECT_EQ(record.reason, "visit(rock) cancelled");
}

TEST_F(EpisodeTest, ATrialMayFailThoughItsActionSucceeded) {
  Finds({2, 0, 1});
  world_.results = {{ActionState::kSucceeded, TrialOutcome::kFailure, "time"}};
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "failed");
  EXPECT_EQ(record.reason, "it ran out of time");
}

TEST_F(EpisodeTest, AnActionThatTheWorldRefusesEndsIt) {
  Finds({2, 0, 1});
  const ActionResult refused{ActionState::kRefused, TrialOutcome::kRunning, "the arm is locked"};
  world_.results = {refused};
  const EpisodeRecord first = Run();
  EXPECT_EQ(first.outcome, "failed");
  EXPECT_EQ(first.reason, "visit(rock) was refused: the arm is locked");
  EXPECT_TRUE(first.acts.empty());

  Finds({2, 0, 1});
  world_.results = {{}, refused};
  EXPECT_EQ(Run().outcome, "stopped") << "something was done";
}

TEST_F(EpisodeTest, ToExplainCarriesNothingOut) {
  options_.explain_only = options_.explain = options_.illustrate = true;
  Finds({2, 0, 1});
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "explained");
  EXPECT_TRUE(world_.carried_out.empty());
  ASSERT_TRUE(record.explanation);
  EXPECT_TRUE(record.explanation->act);
  EXPECT_EQ(record.explanation->task, "visits");
  EXPECT_EQ(record.explanation->rollouts, 30);
  ASSERT_EQ(record.explanation->chosen.steps.size(), 3u);
  EXPECT_FALSE(record.explanation->chosen.steps[0].picture.empty());
  EXPECT_FALSE(record.searches.at(0).steps.at(2).imagined.empty());
}

TEST_F(EpisodeTest, APlanThatAPersonNamesIsJudged) {
  options_.explain_only = options_.explain = true;
  options_.what_if = "visit(tree), visit(barrel)";
  Finds({2, 0, 1});
  const EpisodeRecord record = Run();
  ASSERT_TRUE(record.explanation && record.explanation->what_if);
  EXPECT_EQ(record.explanation->what_if->plan.steps.size(), 2u);
  EXPECT_EQ(std::count(script_.calls.begin(), script_.calls.end(), "judge"), 1);
}

TEST_F(EpisodeTest, AWrongNameCostsNoScene) {
  options_.explain_only = true;
  options_.what_if = "visit(moon)";
  EXPECT_THROW(Run(), UsageError);
  EXPECT_EQ(script_.Text(), "await");
}

TEST_F(EpisodeTest, AGivenPlanIsCarriedOutWithoutAMind) {
  options_.policy = "plan:0,1,2";
  options_.plan = [] { return std::vector<int>{0, 1, 2}; };
  const EpisodeRecord record = Episode(world_, nullptr, options_, told_).Run();
  EXPECT_EQ(record.outcome, "solved");
  EXPECT_EQ(record.policy, "plan:0,1,2");
  EXPECT_EQ(script_.Text(), "await begin carry_out(0) look carry_out(1) look carry_out(2) look");
  EXPECT_TRUE(record.searches.empty());
}

TEST_F(EpisodeTest, AGivenPlanMayEndTooEarly) {
  options_.plan = [] { return std::vector<int>{0}; };
  const EpisodeRecord record = Episode(world_, nullptr, options_, told_).Run();
  EXPECT_EQ(record.outcome, "stopped");
  EXPECT_EQ(record.reason, "the given plan ended before the task was complete");
  EXPECT_EQ(told_.lines, (std::vector<std::string>{"1/1 visit(barrel): succeeded"}));
}

TEST_F(EpisodeTest, InOpenLoopThePlanIsSearchedOnce) {
  options_.open_loop = true;
  mind_.plans = {PlanOf({2, 0, 1})};
  EXPECT_EQ(Run().outcome, "solved");
  EXPECT_EQ(mind_.questions.size(), 1u);

  world_.carried_out.clear();
  mind_.plans = {PlanOf({2})};  // the search looks no further
  const EpisodeRecord record = Run();
  EXPECT_EQ(record.outcome, "stopped");
  EXPECT_EQ(record.acts.size(), 1u);
}

// Whoever falls silent at whatever moment: the episode is told as far as it came.
TEST_F(EpisodeTest, SilenceAtAnyMomentLeavesARecord) {
  struct Moment {
    std::string call;
    int after, acts;
  };
  const std::vector<Moment> moments = {
      {"await", 0, 0},        {"begin", 0, 0}, {"choose", 0, 0},  {"calibration", 0, 0},
      {"search", 0, 0},       {"judge", 0, 0}, {"imagine", 0, 0}, {"familiar", 0, 0},
      {"carry_out(2)", 0, 1}, {"look", 0, 1},  {"search", 1, 1},  {"imagine", 1, 1},
      {"carry_out(0)", 0, 2}, {"look", 1, 2},  {"search", 2, 2},  {"carry_out(1)", 0, 3}};
  for (const Moment& moment : moments) {
    Script script;
    script.silent_at = moment.call;
    script.after = moment.after;
    ScriptedWorld world(script);
    ScriptedMind mind(script);
    mind.plans = {PlanOf({2, 0, 1}), PlanOf({0, 1}), PlanOf({1})};
    options_.novelty = 0.01;
    options_.explain = options_.illustrate = true;
    options_.what_if = "visit(tree)";
    Episode episode(world, &mind, options_, told_);
    EXPECT_THROW(episode.Run(), Lost) << moment.call;
    EXPECT_EQ(script.calls.back(), moment.call) << "and nothing is done after it";
    const EpisodeRecord record = episode.Stopped(moment.call + " fell silent");
    EXPECT_EQ(record.outcome, "stopped");
    EXPECT_EQ(record.reason, moment.call + " fell silent");
    EXPECT_EQ(record.acts.size(), static_cast<std::size_t>(moment.acts))
        << moment.call << " " << moment.after;
    EXPECT_EQ(record.seed, 7);
    if (moment.call.rfind("carry_out", 0) == 0) {
      EXPECT_EQ(record.acts.back().observed, "unknown") << "nobody knows how far it came";
    }
  }
}

}  // namespace
}  // namespace prospect::agent

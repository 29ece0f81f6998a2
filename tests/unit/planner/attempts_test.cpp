#include "planner/attempts.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "tests/unit/planner/goal_table.h"

namespace prospect::planner {
namespace {

// PickAndPut: 0 to 2 pick, 3 to 5 put, 6 to 8 home; after put one may go home or pick again.

Plan Scoring(double score, Path path) {
  Plan plan;
  plan.status = PlanStatus::kPlan;
  plan.best.path = std::move(path);
  plan.best.score = score;
  return plan;
}

Plan Refused(const std::string& reason) {
  Plan plan;
  plan.status = PlanStatus::kRefused;
  plan.reason = reason;
  return plan;
}

// Answers by what counts as carried out; an attempt that was not foreseen fails the test.
class Answers {
 public:
  void Set(Path executed, int plan_length, Plan plan) {
    answers_[{std::move(executed), plan_length}] = std::move(plan);
  }
  Attempts::SearchFor Search() {
    return [this](const Attempt& attempt) {
      ++asked;
      return answers_.at({attempt.executed, attempt.plan_length});
    };
  }
  int asked = 0;

 private:
  std::map<std::pair<Path, int>, Plan> answers_;
};

TEST(BeginAnew, OnlyWhereOneMayGoOnToo) {
  const TaskRules rules = PickAndPut(3);
  EXPECT_FALSE(MayBeginAnew(rules, {}));
  EXPECT_FALSE(MayBeginAnew(rules, {0}));
  EXPECT_TRUE(MayBeginAnew(rules, {0, 4}));
  EXPECT_FALSE(MayBeginAnew(rules, {0, 4, 7})) << "home: nothing is left to go on with";
  EXPECT_FALSE(MayBeginAnew(AnyOrder(4, 3), {1})) << "visits are never begun anew";
}

TEST(BeginAnew, CutsTheUnfinishedPartOutButForItsLastAction) {
  const TaskRules rules = PickAndPut(6);
  const Attempt anew = BegunAnew(rules, {{0, 4, 7, 1, 5}, 6});
  EXPECT_EQ(anew.executed, (Path{0, 4, 7, 5})) << "the first tower stands and still counts";
  EXPECT_EQ(anew.plan_length, 7);
  EXPECT_THROW(BegunAnew(rules, {{0}, 6}), std::invalid_argument);
}

TEST(BeginAnew, LeavesRoomForAWholePlanAndNothingElse) {
  const TaskRules rules = PickAndPut(3);
  const Attempt anew = BegunAnew(rules, {{0, 4}, 3});
  const TaskRules longer = RulesFor(rules, anew);
  EXPECT_EQ(longer.AllowedActions(anew.executed, {}), (std::vector<int>{0, 1, 2}));
  EXPECT_TRUE(longer.Legal(anew.executed, {1, 3, 6}));
  EXPECT_TRUE(longer.Complete(anew.executed, {1, 3, 6}));
}

TEST(BeginAnew, ForgetsForTheGoalWhatWasLost) {
  TaskRules rules = PickAndPut(3);
  SetGoal(TermsOf(ParseGoal("on(red,green)"), PickAndPutFacts()), &rules);
  const Attempt anew = BegunAnew(rules, {{0, 4}, 3});
  const TaskRules longer = RulesFor(rules, anew);
  EXPECT_TRUE(longer.Legal(anew.executed, {0, 4, 7}));
  EXPECT_FALSE(longer.Legal(anew.executed, {1, 5, 8}))
      << "red slipped: it is to be put there again";
}

TEST(Attempts, ActsOnThePlanWhileItIsGood) {
  Attempts attempts(PickAndPut(3), 1);
  Answers answers;
  answers.Set({}, 3, Scoring(0.9, {0, 4, 7}));
  answers.Set({0}, 3, Scoring(0.9, {4, 7}));
  answers.Set({0, 4}, 3, Scoring(0.9, {7}));
  for (const int expected : {0, 4, 7}) {
    const NextStep next = attempts.Next(answers.Search());
    EXPECT_EQ(next.kind, NextStep::Kind::kAct);
    EXPECT_EQ(next.action, expected);
    attempts.CarriedOut(next.action);
  }
  EXPECT_EQ(answers.asked, 3) << "beginning anew is not even searched";
  EXPECT_TRUE(attempts.complete());
}

TEST(Attempts, RefusesAtTheStart) {
  Attempts attempts(PickAndPut(3), 1);
  Answers answers;
  answers.Set({}, 3, Refused("hopeless"));
  const NextStep next = attempts.Next(answers.Search());
  EXPECT_EQ(next.kind, NextStep::Kind::kGiveUp);
  EXPECT_EQ(next.action, -1);
  EXPECT_EQ(next.plan.reason, "hopeless");
}

// Lost in the middle: on to where it can begin anew, then anew.
TEST(Attempts, CarriesOnToWhereItCanBeginAnew) {
  Attempts attempts(PickAndPut(3), 1);
  Answers answers;
  answers.Set({}, 3, Scoring(0.9, {0, 4, 7}));
  answers.Set({0}, 3, Refused("dropped"));
  answers.Set({0, 4}, 3, Refused("no tower"));
  answers.Set({4}, 4, Scoring(0.6, {1, 3, 6}));
  answers.Set({4, 1}, 4, Scoring(0.6, {3, 6}));
  attempts.CarriedOut(attempts.Next(answers.Search()).action);
  NextStep next = attempts.Next(answers.Search());
  EXPECT_EQ(next.kind, NextStep::Kind::kCarryOn);
  EXPECT_EQ(next.action, 4);
  attempts.CarriedOut(4);
  next = attempts.Next(answers.Search());
  EXPECT_EQ(next.kind, NextStep::Kind::kAnew);
  EXPECT_EQ(next.action, 1);
  EXPECT_EQ(attempts.begun_anew(), 1);
  attempts.CarriedOut(1);
  EXPECT_FALSE(attempts.complete());
  next = attempts.Next(answers.Search());
  EXPECT_EQ(next.kind, NextStep::Kind::kAct) << "the new attempt is searched like any";
  EXPECT_EQ(next.action, 3);
}

TEST(Attempts, BeginsAnewOnlyWhereThatScoresMore) {
  for (const double anew : {0.2, 0.6}) {
    Attempts attempts(PickAndPut(3), 1);
    attempts.CarriedOut(0);
    attempts.CarriedOut(4);
    Answers answers;
    answers.Set({0, 4}, 3, Scoring(0.4, {7}));
    answers.Set({4}, 4, Scoring(anew, {1, 3, 6}));
    const NextStep next = attempts.Next(answers.Search());
    EXPECT_EQ(next.action, anew > 0.4 ? 1 : 7);
    EXPECT_DOUBLE_EQ(next.going_on, anew > 0.4 ? 0.4 : 0);
  }
}

// A picture that is not the imagined one outweighs a high score of going on.
TEST(Attempts, BeginsAnewWhenSurprised) {
  for (const double surprise : {0.2, 0.4}) {
    Attempts attempts(PickAndPut(3), 1, {0.3, 1});
    attempts.CarriedOut(0);
    attempts.CarriedOut(4);
    Answers answers;
    answers.Set({0, 4}, 3, Scoring(0.9, {7}));
    answers.Set({4}, 4, Scoring(0.6, {1, 3, 6}));
    const NextStep next = attempts.Next(answers.Search(), surprise);
    EXPECT_EQ(next.action, surprise > 0.3 ? 1 : 7);
    EXPECT_DOUBLE_EQ(next.surprise, surprise > 0.3 ? surprise : 0);
  }
}

// What went wrong early is not forgotten because a later search finds another plan, which then
// surprises no more; but it does not count against the plan that was begun anew.
TEST(Attempts, RemembersAnEarlierSurpriseUntilItBeginsAnew) {
  for (const double early : {0.35, 0.5}) {
    Attempts attempts(PickAndPut(3), 2, {0.3, 0.4});
    Answers answers;
    answers.Set({0}, 3, Scoring(0.9, {4, 7}));
    answers.Set({0, 4}, 3, Scoring(0.9, {7}));
    answers.Set({4}, 4, Scoring(0.6, {1, 3, 6}));
    answers.Set({4, 1}, 4, Scoring(0.6, {3, 6}));
    answers.Set({4, 1, 3}, 4, Scoring(0.6, {6}));
    attempts.CarriedOut(0);
    NextStep next = attempts.Next(answers.Search(), early);
    EXPECT_EQ(next.kind, NextStep::Kind::kAct) << "nothing can be begun anew here";
    attempts.CarriedOut(next.action);
    next = attempts.Next(answers.Search(), 0.1);
    EXPECT_EQ(next.kind, early > 0.4 ? NextStep::Kind::kAnew : NextStep::Kind::kAct);
    if (next.kind == NextStep::Kind::kAct) continue;
    EXPECT_DOUBLE_EQ(next.surprise, early);
    for (const int expected : {1, 3}) {
      EXPECT_EQ(next.action, expected);
      attempts.CarriedOut(next.action);
      next = attempts.Next(answers.Search(), 0.1);
    }
    EXPECT_EQ(next.action, 6) << "the new plan is believed";
  }
}

// A first tower that surprised is not mended by beginning the second one anew.
TEST(Attempts, ForgetsASurpriseWithThePartItWasAbout) {
  Attempts attempts(PickAndPut(6), 1, {0.3, 0.4});
  Answers answers;
  answers.Set({0}, 6, Scoring(0.9, {4, 7, 1, 5, 8}));
  answers.Set({0, 4, 7, 1, 5}, 6, Scoring(0.9, {8}));
  answers.Set({0, 4, 7, 5}, 7, Scoring(0.6, {1, 3, 6}));
  attempts.CarriedOut(0);
  attempts.Next(answers.Search(), 0.9);
  for (const int action : {4, 7, 1, 5}) attempts.CarriedOut(action);
  EXPECT_EQ(attempts.Next(answers.Search(), 0.1).action, 8);
}

// Where no other plan is possible, the present one is kept and nothing else is even searched.
TEST(Attempts, KeepsThePresentPlanWhereNoOtherIsPossible) {
  TaskRules rules = PickAndPut(3);
  SetGoal(TermsOf(ParseGoal("on(red,blue)"), PickAndPutFacts()), &rules);
  rules.successors[5] = {1, 8};  // whoever has put something on blue cannot pick red again
  rules.Prepare();
  Attempts attempts(rules, 1, {0.3, 1});
  attempts.CarriedOut(0);
  attempts.CarriedOut(5);
  ASSERT_TRUE(MayBeginAnew(rules, attempts.current().executed));
  EXPECT_FALSE(CanBeDone(rules, BegunAnew(rules, attempts.current())));
  Answers answers;
  answers.Set({0, 5}, 3, Scoring(0.2, {8}));
  const NextStep next = attempts.Next(answers.Search(), 0.9);
  EXPECT_EQ(next.kind, NextStep::Kind::kAct);
  EXPECT_EQ(next.action, 8);
  EXPECT_EQ(answers.asked, 1);
}

TEST(Attempts, BeginsNothingAnewThatIsLongerThanAPath) {
  Attempts attempts(PickAndPut(kMaxPathLength), 1, {0.3, 1});
  attempts.CarriedOut(0);
  attempts.CarriedOut(4);
  Answers answers;
  answers.Set({0, 4}, kMaxPathLength, Scoring(0.2, {7}));
  EXPECT_EQ(attempts.Next(answers.Search(), 0.9).action, 7);
}

TEST(Attempts, HeedsSurprisesWhereItMayStillBeginAnew) {
  EXPECT_TRUE(Attempts(PickAndPut(3), 1).heeds_surprises());
  EXPECT_FALSE(Attempts(PickAndPut(3), 0).heeds_surprises());
  EXPECT_FALSE(Attempts(AnyOrder(4, 3), 1).heeds_surprises()) << "visits are never begun anew";
}

// PickAndPut with 9, a step back after a put: from there, too, one may go home or pick again.
TaskRules PickPutAndStepBack(int plan_length) {
  TaskRules rules = PickAndPut(plan_length);
  rules.num_actions = 10;
  for (int put = 3; put <= 5; ++put) rules.successors[put] = {0, 1, 2, 9};
  rules.successors.insert(rules.successors.end() - 1, {0, 1, 2, 7});
  rules.Prepare();
  return rules;
}

// A hand that is still there hides what it has let go of.
TEST(Attempts, WaitsForALaterViewWhenSurprised) {
  Attempts attempts(PickPutAndStepBack(4), 1, {0.3, 1});
  attempts.CarriedOut(0);
  attempts.CarriedOut(4);
  Answers answers;
  answers.Set({0, 4}, 4, Scoring(0.9, {9, 7}));
  NextStep next = attempts.Next(answers.Search(), 0.5);
  EXPECT_EQ(next.kind, NextStep::Kind::kAct);
  EXPECT_EQ(next.action, 9);
  attempts.CarriedOut(9);
  answers.Set({0, 4, 9}, 4, Scoring(0.9, {7}));
  answers.Set({9}, 5, Scoring(0.6, {1, 3, 9, 6}));
  next = attempts.Next(answers.Search(), 0.5);
  EXPECT_EQ(next.kind, NextStep::Kind::kAnew);
  EXPECT_EQ(next.action, 1);
}

// It is lost as it is, and waiting would not find it again.
TEST(Attempts, WaitsForNothingWhereGoingOnIsRefused) {
  Attempts attempts(PickPutAndStepBack(4), 1, {0.3, 1});
  attempts.CarriedOut(0);
  attempts.CarriedOut(4);
  Answers answers;
  answers.Set({0, 4}, 4, Refused("lost"));
  answers.Set({4}, 5, Scoring(0.6, {1, 3, 9, 6}));
  EXPECT_EQ(attempts.Next(answers.Search(), 0.5).kind, NextStep::Kind::kAnew);
}

TEST(Attempts, CountsWhatWasCarriedOutOfOnePlan) {
  Attempts attempts(PickAndPut(6), 1);
  Answers answers;
  answers.Set({}, 6, Scoring(0.9, {0, 4, 7, 1, 5, 8}));
  answers.Set({0}, 6, Scoring(0.8, {4, 7, 1, 5, 8}));
  answers.Set({0, 4}, 6, Scoring(0.8, {7, 2, 3, 6}));
  attempts.Next(answers.Search());
  EXPECT_EQ(attempts.followed(), 0);
  attempts.CarriedOut(0);
  attempts.Next(answers.Search());
  EXPECT_EQ(attempts.followed(), 1) << "its rest was found again";
  attempts.CarriedOut(4);
  EXPECT_EQ(attempts.followed(), 2);
  attempts.Next(answers.Search());
  EXPECT_EQ(attempts.followed(), 0) << "another plan";
  attempts.CarriedOut(7);
  EXPECT_EQ(attempts.followed(), 1);
  attempts.CarriedOut(1);
  EXPECT_EQ(attempts.followed(), 0) << "somebody did something else";
}

TEST(Attempts, BeginsAnewNoOftenerThanItMay) {
  for (const int most : {0, 1}) {
    Attempts attempts(PickAndPut(3), most);
    Answers answers;
    answers.Set({0, 4}, 3, Refused("no tower"));
    answers.Set({4}, 4, Scoring(0.6, {1, 3, 6}));
    answers.Set({4, 1, 3}, 4, Refused("no tower again"));
    attempts.CarriedOut(0);
    attempts.CarriedOut(4);
    EXPECT_EQ(attempts.Next(answers.Search()).action, most == 0 ? -1 : 1);
    if (most == 0) continue;
    attempts.CarriedOut(1);
    attempts.CarriedOut(3);
    EXPECT_EQ(attempts.Next(answers.Search()).kind, NextStep::Kind::kGiveUp);
  }
}

// What was carried out is not what was planned: nothing is left to carry on with.
TEST(Attempts, DoesNotCarryOnWithAPlanThatWasLeft) {
  Attempts attempts(PickAndPut(3), 1);
  Answers answers;
  answers.Set({}, 3, Scoring(0.9, {0, 4, 7}));
  answers.Set({1}, 3, Refused("lost"));
  attempts.Next(answers.Search());
  attempts.CarriedOut(1);
  EXPECT_EQ(attempts.Next(answers.Search()).kind, NextStep::Kind::kGiveUp);
}

}  // namespace
}  // namespace prospect::planner

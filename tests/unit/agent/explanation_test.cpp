// What a person is told of a search: the sentences must say what happened, and nothing else.

#include "agent/explanation.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "agent/explanation_text.h"
#include "agent/refusal_reason.h"
#include "agent/what_if.h"
#include "agent/why_lost.h"
#include "base/number_format.h"
#include "planner/apart.h"

namespace prospect::agent {
namespace {

using planner::Future;
using planner::Path;
using planner::Plan;
using planner::PlanStatus;
using planner::PlanStep;
using planner::Rejection;

// Four actions in any order, plans of three.
PlanContext Context() {
  PlanContext context;
  context.rules = planner::AnyOrder(4, 3);
  context.parameters.refusal_threshold = 0.2;
  context.parameters.v_failed = 0.1;
  context.names = {"a", "b", "c", "lift_from(green)"};
  return context;
}

struct Said {
  int action;
  double value;
  double done = 1;
  double prior = 1;
};

// A future as the planner writes it out.
Future FutureOf(const std::vector<Said>& steps, Rejection rejection, std::int64_t visits = 1) {
  Future future;
  double done = 1;
  for (const Said& said : steps) {
    PlanStep step;
    step.action = said.action;
    step.value = static_cast<float>(said.value);
    step.done = static_cast<float>(said.done);
    step.prior = static_cast<float>(said.prior);
    step.score = (done *= step.done) * step.value;
    future.path.push_back(static_cast<std::uint8_t>(said.action));
    future.steps.push_back(step);
  }
  future.score = rejection == Rejection::kNotPermitted ? 0 : future.steps.back().score;
  future.visits = visits;
  future.complete = steps.size() == 3;
  future.rejection = rejection;
  return future;
}

Plan PlanWith(const Future& best) {
  Plan plan;
  plan.status = PlanStatus::kPlan;
  plan.best = best;
  plan.root_value = 0.6f;
  return plan;
}

Plan Good() { return PlanWith(FutureOf({{0, 0.7}, {1, 0.8}, {2, 0.88}}, Rejection::kNone, 10)); }

std::string Why(const Future& future) { return WhyLost(future, Good(), Context()); }

TEST(WhyLostTest, NamesTheStepAtWhichValueFell) {
  const auto future = FutureOf({{0, 0.7}, {1, 0.71}, {3, 0.02}}, Rejection::kLowValue);
  EXPECT_EQ(Why(future),
            "V fell from 0.71 to 0.02 at step 3, lift_from(green); below 0.10 a future is given "
            "up.");
}

TEST(WhyLostTest, TheFirstStepFallsFromTheScene) {
  EXPECT_EQ(Why(FutureOf({{3, 0.05}}, Rejection::kLowValue)),
            "V fell from 0.60 to 0.05 at step 1, lift_from(green); below 0.10 a future is given "
            "up.");
}

TEST(WhyLostTest, SaysWhereMostWasLostIfThatWasBefore) {
  EXPECT_EQ(Why(FutureOf({{0, 0.9}, {1, 0.15}, {2, 0.09}}, Rejection::kLowValue)),
            "V fell from 0.15 to 0.09 at step 3, c; below 0.10 a future is given up. Most was lost "
            "before: from 0.90 to 0.15 at step 2, b.");
}

// Of a scene that is given little, an action may be given more and still be given up.
TEST(WhyLostTest, ValueThatRoseDidNotFall) {
  Plan plan = Good();
  plan.root_value = 0.03f;
  const auto why = WhyLost(FutureOf({{1, 0.06}}, Rejection::kLowValue), plan, Context());
  EXPECT_EQ(why, "V is only 0.06 at step 1, b; below 0.10 a future is given up.");
  plan.root_value = 0.06f;
  EXPECT_EQ(WhyLost(FutureOf({{1, 0.06}}, Rejection::kLowValue), plan, Context()), why);
}

TEST(WhyLostTest, NumbersThatAreComparedDiffer) {
  const auto why = Why(FutureOf({{1, 0.0999}}, Rejection::kLowValue));
  EXPECT_NE(why.find("to 0.0999 at"), std::string::npos) << why;
  EXPECT_NE(why.find("below 0.1000 a"), std::string::npos) << why;
  EXPECT_EQ(base::Apart(0.52, 0.88), "0.52");
  EXPECT_EQ(base::Apart(0.8801, 0.8803), "0.8801");
  EXPECT_EQ(base::Apart(0.5, 0.5), "0.50");
  EXPECT_EQ(base::Apart(0.5, 0.5 + 1e-9), "0.500000");
  EXPECT_EQ(base::Apart(0.0316, 0.032, 3), "0.0316");
}

TEST(WhyLostTest, AnActionThatWouldFail) {
  EXPECT_EQ(Why(FutureOf({{0, 0.7}, {1, 0.5, 0.03}}, Rejection::kNotDone)),
            "f of step 2 is 0.03, below 0.10: the model expects b to fail.");
}

TEST(WhyLostTest, WhatPForbids) {
  EXPECT_EQ(Why(FutureOf({{0, 0.7}, {1, 0, 0, 0.002}}, Rejection::kNotPermitted)),
            "p forbids step 2, b: p is 0.002, below 0.010.");
}

TEST(WhyLostTest, AScoreBelowTheThreshold) {
  EXPECT_EQ(Why(FutureOf({{0, 0.7}, {1, 0.5}, {3, 0.3, 0.5}}, Rejection::kLowScore)),
            "Scores 0.15, below the 0.20 under which plans are refused: V at its end is 0.30, its "
            "f multiply to 0.50.");
}

TEST(WhyLostTest, LessBecauseOfItsEnd) {
  EXPECT_EQ(Why(FutureOf({{0, 0.7}, {1, 0.5}, {3, 0.52}}, Rejection::kNone)),
            "Scores less: 0.52 against 0.88. V at its end is 0.52, the chosen plan's 0.88.");
}

TEST(WhyLostTest, LessBecauseOfItsSteps) {
  EXPECT_EQ(Why(FutureOf({{0, 0.7, 0.9}, {1, 0.5, 0.6}, {3, 0.9}}, Rejection::kNone)),
            "Scores less: 0.49 against 0.88. Its f multiply to 0.54, the chosen plan's to 1.00; "
            "the weakest is step 2, b (f 0.60).");
}

TEST(WhyLostTest, TiesAreToldAsTies) {
  const std::vector<Said> same{{1, 0.7}, {0, 0.8}, {2, 0.88}};
  EXPECT_EQ(Why(FutureOf(same, Rejection::kNone, 3)),
            "Scores the same, 0.88; the chosen plan was visited more often (10 times against 3).");
  EXPECT_EQ(Why(FutureOf(same, Rejection::kNone, 10)),
            "Scores the same, 0.88, and was visited as often: of equals, the plan whose actions "
            "stand first in the task's table is taken.");
}

TEST(WhyLostTest, ADifferenceTooSmallForTwoDigitsIsShown) {
  const auto why = Why(FutureOf({{1, 0.7}, {0, 0.8}, {2, 0.8799}}, Rejection::kNone));
  EXPECT_EQ(why.rfind("Scores less: 0.8799 against 0.8800.", 0), 0u) << why;
}

TEST(WhyLostTest, NothingIsSaidOfAnEmptyFuture) { EXPECT_EQ(Why(Future{}), ""); }

std::string NamesOf(const ExplainedPlan& plan) {
  std::string names;
  for (const auto& step : plan.steps) names += step.name.substr(0, 1);
  return names;
}

TEST(ExplainTest, OneOfEachOtherFirstActionTheBestFirst) {
  Plan plan = Good();
  plan.runners_up = {FutureOf({{0, 0.7}, {1, 0.8}, {3, 0.86}}, Rejection::kNone),
                     FutureOf({{0, 0.7}, {2, 0.8}, {3, 0.85}}, Rejection::kNone),
                     FutureOf({{1, 0.7}, {2, 0.8}, {3, 0.5}}, Rejection::kNone),
                     FutureOf({{1, 0.7}, {2, 0.8}, {0, 0.4}}, Rejection::kNone)};
  plan.rejected = {FutureOf({{2, 0.5}, {1, 0, 0, 0.001}}, Rejection::kNotPermitted),
                   FutureOf({{2, 0.5}, {3, 0.05}}, Rejection::kLowValue),
                   FutureOf({{3, 0.5, 0.02}}, Rejection::kNotDone)};
  const Explanation explanation = Explain(plan, Context());
  EXPECT_TRUE(explanation.act);
  EXPECT_EQ(NamesOf(explanation.chosen), "abc");
  EXPECT_EQ(explanation.chosen.why, "");
  EXPECT_EQ(explanation.chosen.shared, 0);
  std::vector<std::string> shown;
  for (const auto& other : explanation.alternatives) shown.push_back(NamesOf(other));
  // One beginning with c: the one whose last step was imagined. Both that part from the chosen plan
  // later than the others have beginnings are there as far as there is room.
  EXPECT_EQ(shown, (std::vector<std::string>{"abl", "acl", "bcl", "cl", "l"}));
  EXPECT_EQ(explanation.alternatives[0].shared, 2);
  EXPECT_EQ(explanation.alternatives[3].given_up, 2);
  EXPECT_TRUE(explanation.ruled_out.empty());
  EXPECT_TRUE(explanation.untried.empty());
}

TEST(ExplainTest, WhatWasNotImaginedIsNamedAndNotShown) {
  Plan plan = Good();
  plan.rejected = {FutureOf({{1, 0, 0, 0.004}}, Rejection::kNotPermitted)};
  const Explanation explanation = Explain(plan, Context());
  EXPECT_TRUE(explanation.alternatives.empty());
  EXPECT_EQ(explanation.ruled_out, std::vector<std::string>{"b (p 0.004)"});
  EXPECT_EQ(explanation.untried, (std::vector<std::string>{"c", "lift_from(green)"}));
}

TEST(ExplainTest, AForbiddenStepHasNoPicture) {
  Plan plan = Good();
  plan.rejected = {FutureOf({{2, 0.5}, {1, 0, 0, 0.001}}, Rejection::kNotPermitted)};
  Explanation explanation = Explain(plan, Context());
  ASSERT_EQ(explanation.alternatives.size(), 1u);
  EXPECT_FALSE(explanation.alternatives[0].steps[1].imagined);
  const std::set<Path> states{{0}, {0, 1}, {0, 1, 2}, {2}};
  EXPECT_EQ(StatesShown(explanation), states);
  Picture picture;
  picture.width = picture.height = 1;
  picture.rgb = {1, 2, 3};
  SetPictures({{Path{0, 1}, picture}}, &explanation);
  EXPECT_TRUE(explanation.chosen.steps[0].picture.empty());
  EXPECT_EQ(explanation.chosen.steps[1].picture.rgb, picture.rgb);
}

TEST(ExplainTest, ARefusalShowsTheBestOfTheBadOnesAndWhy) {
  Plan plan = PlanWith(FutureOf({{0, 0.7}, {1, 0.5}, {2, 0.15}}, Rejection::kLowScore));
  plan.status = PlanStatus::kRefused;
  plan.reason = "the best scores 0.150";
  plan.rejected = {plan.best, FutureOf({{1, 0.7}, {0, 0.5}, {2, 0.12}}, Rejection::kLowScore)};
  const Explanation explanation = Explain(plan, Context());
  EXPECT_FALSE(explanation.act);
  EXPECT_EQ(Headline(explanation), "Refuse");
  EXPECT_EQ(explanation.reason.rfind("no plan scores enough; closest: a, b, c: score 0.15, below "
                                     "0.20; ",
                                     0),
            0u)
      << explanation.reason;
  EXPECT_EQ(explanation.chosen.why.rfind("Scores 0.15, below the 0.20", 0), 0u);
  // The best itself is not listed again.
  ASSERT_EQ(explanation.alternatives.size(), 1u);
  EXPECT_EQ(explanation.alternatives[0].why.rfind("Scores 0.12, below the 0.20", 0), 0u);
}

TEST(ExplainTest, WhereEveryFutureFailsThereIsNoBest) {
  Plan plan;
  plan.status = PlanStatus::kRefused;
  plan.reason = "every future fails";
  plan.root_value = 0.3f;
  plan.rejected = {FutureOf({{2, 0.5}, {3, 0.05}}, Rejection::kLowValue),
                   FutureOf({{1, 0.5, 0.01}}, Rejection::kNotDone)};
  const Explanation explanation = Explain(plan, Context());
  EXPECT_TRUE(explanation.chosen.steps.empty());
  EXPECT_EQ(explanation.alternatives.size(), 2u);
  const std::string text = ExplanationText(explanation);
  EXPECT_EQ(text.rfind("Refuse. Every future fails; closest: step 2, lift_from(green): V 0.05, "
                       "below 0.10; ",
                       0),
            0u)
      << text;
  EXPECT_NE(text.find("f of step 1 is 0.01"), std::string::npos) << text;
}

// The first sentence of a refusal names what came closest, with its number and the bound.
TEST(RefusalReasonTest, NamesTheNearestMiss) {
  Plan plan;
  plan.status = PlanStatus::kRefused;
  plan.rejected = {FutureOf({{1, 0.5, 0.0996}}, Rejection::kNotDone),
                   FutureOf({{2, 0.5, 0.01}}, Rejection::kNotDone)};
  plan.not_done = 2;
  EXPECT_EQ(RefusalReason(plan, Context()),
            "every future fails; closest: step 1, b: f 0.0996, below 0.1000; in all: 2 with an "
            "action that would not finish (f < 0.100)");
  plan.rejected.insert(plan.rejected.begin(),
                       FutureOf({{0, 0.5}, {3, 0, 0, 0.002}}, Rejection::kNotPermitted));
  plan.not_permitted = 1;
  EXPECT_EQ(RefusalReason(plan, Context())
                .rfind("every future fails; closest: step 2, lift_from(green): p 0.002, below", 0),
            0u);
  EXPECT_EQ(RefusalReason(Good(), Context()), "");
  Plan unknown;
  unknown.reason = "the scene itself was not evaluated";
  EXPECT_EQ(RefusalReason(unknown, Context()), unknown.reason);
}

TEST(ExplainTest, NothingAtAllIsKnown) {
  Plan plan;
  plan.reason = "the scene itself was not evaluated";
  const Explanation explanation = Explain(plan, Context());
  EXPECT_EQ(Headline(explanation), "Refuse");
  EXPECT_EQ(explanation.untried.size(), 4u);
  EXPECT_EQ(ExplanationText(explanation), "Refuse. The scene itself was not evaluated.\n");
}

TEST(ExplainTest, AnUnfinishedFutureIsNotCalledRefusedForItsScore) {
  Plan plan = PlanWith(FutureOf({{0, 0.7}, {1, 0.5}}, Rejection::kNone));
  plan.status = PlanStatus::kIncomplete;
  plan.reason = "no future was followed to its end";
  const Explanation explanation = Explain(plan, Context());
  EXPECT_FALSE(explanation.act);
  EXPECT_FALSE(explanation.chosen.to_its_end);
  EXPECT_EQ(explanation.chosen.why, "Not followed to its end: the search came no further.");
}

TEST(ExplainTest, TheTextShowsNoMoreAlternativesThanAskedFor) {
  Plan plan = Good();
  plan.runners_up = {FutureOf({{1, 0.7}, {2, 0.8}, {3, 0.5}}, Rejection::kNone),
                     FutureOf({{2, 0.7}, {0, 0.8}, {3, 0.4}}, Rejection::kNone)};
  const Explanation explanation = Explain(plan, Context());
  EXPECT_NE(ExplanationText(explanation, 2).find("- c, a, lift_from(green)"), std::string::npos);
  EXPECT_EQ(ExplanationText(explanation, 1).find("- c, a, lift_from(green)"), std::string::npos);
  EXPECT_EQ(ExplanationText(explanation, 1)
                .rfind("Act: begin with a. Score 0.88; plans below 0.20 are refused.\n", 0),
            0u);
}

TEST(NamedPlanTest, FindsNamesWithCommasInTheirBrackets) {
  const std::vector<std::string> names{"go(a,b)", "stop"};
  EXPECT_EQ(NamedPlan("stop, go(a,b)", names), (Path{1, 0}));
  EXPECT_EQ(NamedPlan(" stop ", names), (Path{1}));
}

TEST(NamedPlanTest, SaysWhatIsWrongAndWhatThereIs) {
  const std::vector<std::string> names{"go(a,b)", "stop"};
  for (const char* text :
       {"", "stop,", ",stop", "stop,,stop", "go(a", "jump", "stop go(a,b)", "7"}) {
    try {
      NamedPlan(text, names);
      ADD_FAILURE() << "'" << text << "' was taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("go(a,b), stop"), std::string::npos) << error.what();
    }
  }
  std::string longest = "stop";
  for (int i = 1; i < planner::kMaxPathLength; ++i) longest += ",stop";
  EXPECT_EQ(NamedPlan(longest, names).size(), static_cast<std::size_t>(planner::kMaxPathLength));
  EXPECT_THROW(NamedPlan(longest + ",stop", names), std::invalid_argument);
}

// Evaluations of every beginning of `steps`, as far as it is given.
std::map<Path, planner::Evaluation> Evaluations(const std::vector<Said>& steps) {
  std::map<Path, planner::Evaluation> evaluations;
  Path path;
  planner::Evaluation here;
  here.value = 0.6f;
  for (std::size_t i = 0;; ++i) {
    here.q.assign(4, 0.5f);
    here.p.assign(4, 1.0f);
    if (i < steps.size())
      here.p[static_cast<std::size_t>(steps[i].action)] = static_cast<float>(steps[i].prior);
    evaluations[path] = here;
    if (i == steps.size()) return evaluations;
    path.push_back(static_cast<std::uint8_t>(steps[i].action));
    here.value = static_cast<float>(steps[i].value);
    here.done = static_cast<float>(steps[i].done);
  }
}

WhatIf Ask(const std::vector<Said>& steps, const Plan& plan = Good()) {
  Path path;
  for (const Said& said : steps) path.push_back(static_cast<std::uint8_t>(said.action));
  return JudgePlan(path, Evaluations(steps), plan, Context());
}

TEST(WhatIfTest, ScoresLikeTheSearch) {
  const WhatIf what_if = Ask({{1, 0.7, 0.9}, {0, 0.6, 0.8}, {2, 0.5, 0.7}});
  ASSERT_EQ(what_if.plan.steps.size(), 3u);
  EXPECT_NEAR(what_if.plan.steps[1].score, 0.9 * 0.8 * 0.6, 1e-6);
  EXPECT_NEAR(what_if.plan.score, 0.9 * 0.8 * 0.7 * 0.5, 1e-6);
  EXPECT_EQ(what_if.plan.given_up, 0);
  EXPECT_EQ(what_if.forbidden, 0);
  ASSERT_EQ(what_if.findings.size(), 1u);
  EXPECT_EQ(what_if.findings[0].rfind("Scores less: 0.25 against 0.88.", 0), 0u);
}

TEST(WhatIfTest, TheChosenPlanIsRecognised) {
  const WhatIf what_if = Ask({{0, 0.7}, {1, 0.8}, {2, 0.88}});
  EXPECT_EQ(what_if.findings, std::vector<std::string>{"It is the chosen plan."});
}

TEST(WhatIfTest, ABetterPlanThatTheSearchMissedIsSaidToBeBetter) {
  const WhatIf what_if = Ask({{1, 0.7}, {0, 0.8}, {2, 0.95}});
  EXPECT_EQ(what_if.findings[0],
            "It scores more than the chosen plan, 0.95 against 0.88: the search did not come to "
            "it. More samples might.");
}

TEST(WhatIfTest, ABeginningIsNotComparedWithAWholePlan) {
  EXPECT_EQ(Ask({{0, 0.7}, {1, 0.8}}).findings[0],
            "It is the beginning of a plan: so far it scores 0.80. The chosen plan begins with the "
            "same steps.");
  EXPECT_EQ(Ask({{1, 0.4}}).findings[0],
            "It is the beginning of a plan: so far it scores 0.40. The chosen plan scores 0.70 "
            "after as many steps.");
}

TEST(WhatIfTest, EveryTroubleIsToldTheFirstOneFirst) {
  const WhatIf what_if = Ask({{1, 0.7, 1, 0.001}, {0, 0.6, 0.05}, {2, 0.5}});
  EXPECT_EQ(what_if.plan.given_up, 1);
  ASSERT_EQ(what_if.findings.size(), 3u);
  EXPECT_EQ(what_if.findings[0].rfind("p forbids step 1, b", 0), 0u);
  EXPECT_EQ(what_if.findings[1], "f of step 2 is 0.05, below 0.10: the model expects a to fail.");
  EXPECT_EQ(what_if.findings[2],
            "The search would give it up there; followed to its end all the same, it scores 0.03.");
}

TEST(WhatIfTest, TheRulesForbidAStepAndWhatComesAfterIsNotImagined) {
  Path path{1, 0, 1};
  const WhatIf what_if = JudgePlan(path, Evaluations({{1, 0.7}, {0, 0.6}}), Good(), Context());
  EXPECT_EQ(what_if.forbidden, 3);
  ASSERT_EQ(what_if.plan.steps.size(), 3u);
  EXPECT_TRUE(what_if.plan.steps[1].imagined);
  EXPECT_FALSE(what_if.plan.steps[2].imagined);
  EXPECT_LT(what_if.plan.steps[2].prior, 0) << "p is not known there";
  EXPECT_EQ(what_if.plan.score, 0);
  EXPECT_EQ(what_if.findings[0],
            "The task's rules forbid step 3, b: it was taken before; allowed there: c, "
            "lift_from(green).");
}

TEST(WhatIfTest, NothingFollowsAWholePlan) {
  const WhatIf what_if =
      JudgePlan({0, 1, 2, 3}, Evaluations({{0, 0.7}, {1, 0.6}, {2, 0.5}}), Good(), Context());
  EXPECT_EQ(what_if.forbidden, 4);
  EXPECT_EQ(what_if.findings[0],
            "The task's rules forbid step 4, lift_from(green): the plan is complete before it.");
}

TEST(WhatIfTest, AForbiddenFirstStepIsNotImaginedAtAll) {
  PlanContext context = Context();
  context.rules.successors.back() = {0, 1};
  const WhatIf what_if = JudgePlan({2}, Evaluations({}), Good(), context);
  EXPECT_EQ(what_if.forbidden, 1);
  EXPECT_EQ(what_if.findings[0], "The task's rules forbid step 1, c: allowed there: a, b.");
}

TEST(WhatIfTest, AgainstARefusal) {
  Plan plan = PlanWith(FutureOf({{0, 0.7}, {1, 0.5}, {2, 0.15}}, Rejection::kLowScore));
  plan.status = PlanStatus::kRefused;
  EXPECT_EQ(Ask({{1, 0.7}, {0, 0.8}, {2, 0.19}}, plan).findings[0].rfind("Scores 0.19, below", 0),
            0u);
  EXPECT_EQ(Ask({{1, 0.7}, {0, 0.8}, {2, 0.5}}, plan).findings[0],
            "It scores 0.50, not below the 0.20 under which plans are refused: the search did not "
            "come to it.");
}

}  // namespace
}  // namespace prospect::agent

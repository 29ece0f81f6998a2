#include "planner/goal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>
#include <string>

#include "planner/baseline_plans.h"
#include "planner/scripted_model.h"
#include "planner/search.h"
#include "tests/unit/planner/goal_table.h"

namespace prospect::planner {
namespace {

std::string Read(const std::string& text) { return ToString(ParseGoal(text)); }

// What `call` throws, or "nothing".
template <class Error>
std::string ErrorOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

TaskRules WithGoal(TaskRules rules, const std::vector<GoalFact>& known, const std::string& goal) {
  SetGoal(TermsOf(ParseGoal(goal), known), &rules);
  return rules;
}

std::string WhyNot(const TaskRules& rules, const std::vector<GoalFact>& known,
                   const std::string& goal) {
  return ErrorOf<GoalError>([&] { WithGoal(rules, known, goal); });
}

// All complete plans of the rules.
std::set<Path> Plans(const TaskRules& rules) {
  std::set<Path> plans;
  const std::function<void(Path)> grow = [&](Path path) {
    if (rules.Complete({}, path)) plans.insert(path);
    for (const int action : rules.AllowedActions({}, path)) {
      Path longer = path;
      longer.push_back(static_cast<std::uint8_t>(action));
      grow(longer);
    }
  };
  grow({});
  return plans;
}

TEST(ParseGoal, ReadsAtoms) {
  EXPECT_EQ(Read("on(red,blue)"), "on(red,blue)");
  EXPECT_EQ(Read("  on ( red , _ ) "), "on(red,*)");
  EXPECT_EQ(Read("on(*,blue)"), "on(*,blue)");
  EXPECT_EQ(Read("visited(barrel,pylon)"), "visited(barrel,pylon)");
  EXPECT_EQ(Read("on(red,blue); on(blue,green) visited(b_1,b-2)"),
            "on(red,blue), on(blue,green), visited(b_1,b-2)");
  EXPECT_EQ(Read("visited(barrel) visited(barrel)"), "visited(barrel)")
      << "what is said twice counts once";
  EXPECT_EQ(Read(Read("on(_,blue),visited(a,b)")), Read("on(_,blue),visited(a,b)"));
}

TEST(ParseGoal, NamesTheFaultAndWhatIsAllowed) {
  const std::pair<const char*, const char*> faults[] = {
      {"", "it is empty"},
      {" , ", "it is empty"},
      {"red on blue", "'(' is missing"},
      {"o*(red,blue)", "'o*' is no word"},
      {"(red,blue)", "a word is missing"},
      {"on", "'(' is missing"},
      {"on(red", "')' is missing"},
      {"on(red,)", "a name is missing"},
      {"on(r*,blue)", "'r*' is no name"},
      {"visited()", "a name is missing"},
      {"on(red,blue", "')' is missing"},
      {"on(red,blue))", "a word is missing"},
      {"on(red,blue)$", "a word is missing"},
  };
  for (const auto& [text, fault] : faults) {
    const std::string error = ErrorOf<std::invalid_argument>([&, t = text] { ParseGoal(t); });
    EXPECT_NE(error.find(fault), std::string::npos) << text << ": " << error;
    EXPECT_NE(error.find("on(red,blue), on(red,*) or visited"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
}

TEST(ParseGoal, GivesUpOnWhatNobodyMeans) {
  std::string long_goal;
  for (int i = 0; i < 1000; ++i) long_goal += "visited(a" + std::to_string(i) + ") ";
  EXPECT_LT(ErrorOf<std::invalid_argument>([&] { ParseGoal(long_goal); }).size(), 400u);
  long_goal = std::string(100000, 'a');
  EXPECT_LT(ErrorOf<std::invalid_argument>([&] { ParseGoal(long_goal); }).size(), 400u);
  std::mt19937 random(3);
  const std::string letters = "on(visted*_,;) \t\xff\x80";
  for (int round = 0; round < 20000; ++round) {
    std::string text;
    for (unsigned n = random() % 20; n > 0; --n) text += letters[random() % letters.size()];
    try {
      EXPECT_EQ(Read(Read(text)), Read(text));
    } catch (const std::invalid_argument&) {
    }
  }
}

TEST(Holds, MatchesOpenParts) {
  const std::vector<std::string> facts = {"on(red,blue)", "visited(barrel)"};
  EXPECT_TRUE(Holds(ParseGoal("on(red,blue)"), facts));
  EXPECT_TRUE(Holds(ParseGoal("on(*,blue),visited(barrel)"), facts));
  EXPECT_TRUE(Holds(ParseGoal("on(*,*)"), facts));
  EXPECT_FALSE(Holds(ParseGoal("on(blue,red)"), facts));
  EXPECT_FALSE(Holds(ParseGoal("on(red,blue),visited(pylon)"), facts));
  EXPECT_FALSE(Holds(ParseGoal("on(red,*)"), {}));
  EXPECT_TRUE(Holds({}, {}));
}

TEST(SetGoal, AllowsOnlyPlansThatPutOneOnTheOther) {
  const auto known = PickAndPutFacts();
  EXPECT_EQ(Plans(PickAndPut(3)).size(), 6u);
  EXPECT_EQ(Plans(WithGoal(PickAndPut(3), known, "on(red,blue)")), (std::set<Path>{{0, 5, 8}}));
  EXPECT_EQ(Plans(WithGoal(PickAndPut(3), known, "on(red,*)")),
            (std::set<Path>{{0, 4, 7}, {0, 5, 8}}));
  EXPECT_EQ(Plans(WithGoal(PickAndPut(3), known, "on(*,blue)")),
            (std::set<Path>{{0, 5, 8}, {1, 5, 8}}));
  EXPECT_EQ(Plans(WithGoal(PickAndPut(3), known, "on(*,*)")), Plans(PickAndPut(3)));
}

// Where a plan of PickAndPut leaves each block: the name of what it was last put on, or "".
std::vector<std::string> WhereBlocksEnd(const Path& plan) {
  std::vector<std::string> where(GoalNames().size());
  for (std::size_t i = 0; i + 1 < plan.size(); ++i) {
    if (plan[i] < 3) where[plan[i]] = GoalNames()[plan[i + 1] - 3];
  }
  return where;
}

// With two moves the last of each block counts: what is put on blue and then elsewhere is not on
// blue, and others stay where they are.
TEST(SetGoal, WhatIsMovedOnIsNotThereAnyMore) {
  const auto known = PickAndPutFacts();
  const TaskRules red = WithGoal(PickAndPut(6), known, "on(red,blue)");
  const TaskRules any = WithGoal(PickAndPut(6), known, "on(*,blue)");
  const TaskRules open = WithGoal(PickAndPut(6), known, "on(red,*)");
  for (const Path& plan : Plans(PickAndPut(6))) {
    const auto where = WhereBlocksEnd(plan);
    const bool some_on_blue = std::count(where.begin(), where.end(), "blue") > 0;
    EXPECT_EQ(red.Legal({}, plan), where[0] == "blue") << ToString(plan);
    EXPECT_EQ(red.GoalMet({}, plan), where[0] == "blue") << ToString(plan);
    EXPECT_EQ(any.Legal({}, plan), some_on_blue) << ToString(plan);
    EXPECT_EQ(open.Legal({}, plan), !where[0].empty()) << ToString(plan);
  }
  EXPECT_TRUE(red.Legal({}, {1, 5, 8, 0, 5, 8}));
  EXPECT_FALSE(red.Legal({}, {0, 5, 8, 0, 4, 7}));
  EXPECT_TRUE(any.Legal({}, {0, 5, 8, 1, 3, 6})) << "green was moved, and red stays";
}

TEST(SetGoal, SeveralAtomsInAnyOrder) {
  const auto known = PickAndPutFacts();
  EXPECT_EQ(Plans(WithGoal(PickAndPut(6), known, "on(red,blue),on(blue,green)")),
            (std::set<Path>{{0, 5, 8, 2, 4, 7}, {2, 4, 7, 0, 5, 8}}));
  const TaskRules visits = WithGoal(AnyOrder(4, 3), VisitFacts(4), "visited(a,c)");
  const std::set<Path> plans = Plans(visits);
  EXPECT_EQ(plans.size(), 12u) << "a, c and one of two others, in any order";
  for (const Path& plan : plans) {
    EXPECT_TRUE(std::count(plan.begin(), plan.end(), 0) && std::count(plan.begin(), plan.end(), 2));
  }
  EXPECT_EQ(visits.AllowedActions({1}, {}), (std::vector<int>{0, 2})) << "both are still to come";
  EXPECT_EQ(visits.AllowedActions({2}, {0}), (std::vector<int>{1, 3}));
  EXPECT_TRUE(visits.AllowedActions({1}, {3}).empty()) << "too late";
}

TEST(SetGoal, NoGoalLeavesTheRulesAsTheyWere) {
  TaskRules rules = PickAndPut(6);
  SetGoal({}, &rules);
  EXPECT_TRUE(rules.goal.empty());
  EXPECT_TRUE(rules.brings_about.empty());
  EXPECT_EQ(Plans(rules), Plans(PickAndPut(6)));
  EXPECT_TRUE(rules.GoalMet({}, {}));
}

TEST(SetGoal, SaysWhyAGoalIsImpossible) {
  const auto known = PickAndPutFacts();
  const auto stacking = [&](int length, const std::string& goal) {
    return WhyNot(PickAndPut(length), known, goal);
  };
  EXPECT_EQ(stacking(3, "on(red,red)"), "this task cannot bring about on(red,red)");
  EXPECT_EQ(stacking(3, "on(red,purple)"),
            "there is no 'purple' in this task; there are: blue, green, red");
  EXPECT_EQ(stacking(3, "on(red)"),
            "on(red) has 1 names, and not 2: the goals of this task are on(A,B)");
  EXPECT_EQ(stacking(3, "one(red,blue)"),
            "this task has no goal 'one': its goals are on(A,B); did you mean on?");
  EXPECT_EQ(stacking(6, "on(red,blue),on(red,green)"),
            "no plan of this task's 6 actions brings about on(red,blue), on(red,green)");
  EXPECT_EQ(stacking(3, "on(red,blue),on(blue,green)"),
            "no plan of this task's 3 actions brings about on(red,blue), on(blue,green)");
  EXPECT_EQ(stacking(6, "on(red,blue),on(blue,green)"), "nothing");
  EXPECT_EQ(stacking(3, "visited(red)"), "this task has no goal 'visited': its goals are on(A,B)");
  const auto visits = [&](const std::string& goal) {
    return WhyNot(AnyOrder(4, 3), VisitFacts(4), goal);
  };
  EXPECT_EQ(visits("visited(a,b,c)"), "nothing");
  EXPECT_EQ(visits("visited(a,b,c,d)"),
            "no plan of this task's 3 actions brings about visited(a), visited(b), visited(c), "
            "visited(d)");
  EXPECT_EQ(visits("on(a,b)"), "this task has no goal 'on': its goals are visited(A)");
  EXPECT_EQ(WhyNot(AnyOrder(4, 3), {}, "on(a,b)"),
            "this task knows no goals: its task file names none");
  EXPECT_EQ(visits("visited(z)"), "there is no 'z' in this task; there are: a, b, c, d");
  EXPECT_EQ(WhyNot(AnyOrder(12, 12), VisitFacts(12), "visited(a,b,c,d,e,f,g,h,i)"),
            "it asks for too much at once: leave some of it out");
}

// What a term says is what a worker makes of its text.
TEST(Terms, GoThroughText) {
  for (const char* goal : {"on(red,blue)", "on(*,blue)", "on(red,*)", "on(*,*)", "on(blue,red)"}) {
    const auto terms = TermsOf(ParseGoal(goal), PickAndPutFacts());
    ASSERT_EQ(terms.size(), 1u);
    EXPECT_EQ(ParseTerm(ToString(terms[0]), 9), terms[0]) << ToString(terms[0]);
  }
  EXPECT_EQ(ToString(TermsOf(ParseGoal("on(red,blue)"), PickAndPutFacts())[0]),
            "on(red,blue)=0>5!0>4");
  EXPECT_EQ(ToString(TermsOf(ParseGoal("visited(b)"), VisitFacts(3))[0]), "visited(b)=1");
  EXPECT_EQ(ParseTerm(ToString(TermsOf(ParseGoal("visited(b)"), VisitFacts(3))[0]), 3).words,
            "visited(b)");
}

TEST(Terms, OpenPartsTakeAsFewFactsAsCanBe) {
  const auto count = [](const char* goal) {
    return TermsOf(ParseGoal(goal), PickAndPutFacts())[0].facts.size();
  };
  EXPECT_EQ(count("on(red,*)"), 1u);
  EXPECT_EQ(count("on(*,*)"), 1u);
  EXPECT_EQ(count("on(*,blue)"), 2u) << "red may be moved on while green stays";
}

TEST(Terms, NonsenseIsRefused) {
  for (const char* text : {"", "on(red,blue)", "a=", "a=9", "a=0>", "a=0>9", "a=x", "a=-1", "a!1",
                           "a=1/", "a=1//2", "a=1=", "a=0001", "\xff=\xff"})
    EXPECT_THROW(ParseTerm(text, 9), GoalError) << text;
  std::string long_term = "a";
  for (int i = 0; i < 10000; ++i) long_term += "=1";
  EXPECT_THROW(ParseTerm(long_term, 9), GoalError);
  std::mt19937 random(5);
  const std::string letters = "a=!>/0123456789";
  for (int round = 0; round < 20000; ++round) {
    std::string text;
    for (unsigned n = random() % 16; n > 0; --n) text += letters[random() % letters.size()];
    try {
      const GoalTerm term = ParseTerm(text, 9);
      EXPECT_EQ(ParseTerm(ToString(term), 9), term) << text;
      TaskRules rules = PickAndPut(3);
      SetGoal({term}, &rules);
    } catch (const GoalError&) {
    }
  }
}

// Whatever the model says, a search with a goal finds what an exhaustive one finds, and all of it
// has the goal.
TEST(SetGoal, SearchesFindOnlyPlansWithTheGoal) {
  const auto known = PickAndPutFacts();
  const TaskRules rules = WithGoal(PickAndPut(6), known, "on(red,blue)");
  int found = 0, otherwise = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    ScriptedModelParameters scripted;
    scripted.num_actions = 9;
    scripted.seed = seed;
    ScriptedModel model(scripted);
    SearchParameters parameters;
    parameters.samples = 2000;
    parameters.depth = 6;
    Search search(rules, parameters, {}, {});
    RunSearch(&search, &model);
    const Plan plan = search.BestPlan();
    otherwise +=
        !rules.GoalMet({}, ExhaustivePlan(PickAndPut(6), parameters, {}, &model).plan.best.path);
    for (const auto* list : {&plan.runners_up, &plan.rejected}) {
      for (const Future& future : *list) EXPECT_TRUE(rules.Legal({}, future.path));
    }
    EXPECT_TRUE(rules.Legal({}, RandomPlan(rules, {}, seed)));
    EXPECT_TRUE(rules.GoalMet({}, RandomPlan(rules, {}, seed)));
    const Plan best = ExhaustivePlan(rules, parameters, {}, &model).plan;
    EXPECT_EQ(plan.ok(), best.ok());
    if (!plan.ok()) continue;
    ++found;
    EXPECT_EQ(plan.best.path, best.best.path) << "seed " << seed;
    EXPECT_EQ(plan.best.path.size(), 6u);
    EXPECT_TRUE(rules.GoalMet({}, plan.best.path));
  }
  EXPECT_GT(found, 10);
  EXPECT_GT(otherwise, 10) << "without the goal the plan is another one";
}

}  // namespace
}  // namespace prospect::planner

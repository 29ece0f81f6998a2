#include "planner/tower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <tuple>

#include "planner/attempts.h"
#include "planner/goal.h"
#include "tests/unit/planner/goal_table.h"

namespace prospect::planner {
namespace {

const std::vector<std::string> kBlocks = {"red", "green", "blue", "yellow"};

// Actions 0 to 3 pick a block, 4 to 7 stack it on one, 8 to 11 go home; after stacking one may pick
// again.
std::vector<ActionWords> StackingWords() {
  std::vector<ActionWords> words;
  for (const char* kind : {"pick", "stack", "home"}) {
    for (const std::string& name : kBlocks) words.push_back({kind, name});
  }
  return words;
}

TaskRules Stacking(int plan_length) {
  TaskRules rules;
  rules.num_actions = 12;
  rules.plan_length = plan_length;
  rules.repeats_allowed = true;
  rules.successors = {{5, 6, 7},       {4, 6, 7},       {4, 5, 7},        {4, 5, 6},
                      {0, 1, 2, 3, 8}, {0, 1, 2, 3, 9}, {0, 1, 2, 3, 10}, {0, 1, 2, 3, 11},
                      {0, 1, 2, 3},    {0, 1, 2, 3},    {0, 1, 2, 3},     {0, 1, 2, 3},
                      {0, 1, 2, 3}};
  rules.tower = OneTower(StackingWords(), rules);
  rules.Prepare();
  return rules;
}

std::set<Path> Plans(const TaskRules& rules) {
  std::set<Path> plans;
  const std::function<void(const Path&)> grow = [&](const Path& path) {
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

// Whether what is handed over in `plan` can be one tower: each time two parts become one, and in
// the end all is one part. By union of sets, plainly.
bool MakesOneTower(const Path& plan) {
  std::vector<std::set<int>> parts;
  for (int block = 0; block < 4; ++block) parts.push_back({block});
  const auto part_of = [&](int block) {
    return std::find_if(parts.begin(), parts.end(),
                        [&](const std::set<int>& part) { return part.contains(block); });
  };
  for (std::size_t i = 0; i + 1 < plan.size(); ++i) {
    if (plan[i] > 3) continue;
    const auto upper = part_of(plan[i]), lower = part_of(plan[i + 1] - 4);
    if (upper == lower) return false;
    lower->insert(upper->begin(), upper->end());
    parts.erase(upper);
  }
  return std::count_if(parts.begin(), parts.end(),
                       [](const std::set<int>& part) { return part.size() > 1; }) == 1;
}

// Of the table's plans that go straight on: begun anew is what Attempts do.
bool GoesStraightOn(const Path& plan) {
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (plan[i] / 4 != static_cast<int>(i % 3)) return false;
  }
  return true;
}

// Directed edges that make a tree of 2, 3 or 4 blocks, in any order: 12, 96 and 768 of 12, 144 and
// 1,728.
TEST(OneTower, AllowsJustThePlansThatCanBuildIt) {
  const std::tuple<int, int, int> cases[] = {{2, 12, 12}, {3, 144, 96}, {4, 1728, 768}};
  for (const auto& [levels, all, allowed] : cases) {
    const TaskRules rules = Stacking(3 * (levels - 1));
    TaskRules table = rules;
    table.tower = {};
    table.Prepare();
    int plans = 0, legal = 0;
    for (const Path& plan : Plans(table)) {
      if (!GoesStraightOn(plan)) continue;
      ++plans;
      legal += rules.Legal({}, plan);
      EXPECT_EQ(rules.Legal({}, plan), MakesOneTower(plan)) << ToString(plan);
    }
    EXPECT_EQ(plans, all);
    EXPECT_EQ(legal, allowed);
    EXPECT_EQ(TowerLevels(rules), levels);
  }
}

TEST(OneTower, OneRoundIsAsTheTableHasIt) {
  const TaskRules rules = Stacking(3);
  TaskRules table = rules;
  table.tower = {};
  table.Prepare();
  EXPECT_EQ(Plans(rules), Plans(table));
  EXPECT_EQ(TowerLevels(table), 0);
}

// Where a tower cannot stand any more, the table decides, as where a plan cannot end.
TEST(OneTower, WhatIsLostIsLeftToTheTable) {
  const TaskRules rules = Stacking(6);
  const Path lost = {0, 5, 9, 2, 7};
  EXPECT_FALSE(rules.Legal({}, lost)) << "blue on yellow would be a second tower";
  EXPECT_TRUE(rules.Allowed(lost, {}, 11));
  EXPECT_EQ(rules.AllowedActions(lost, {}).back(), 11);
  EXPECT_EQ(rules.AllowedActions({0, 5, 9}, {}), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(rules.AllowedActions({0, 5, 9, 0}, {}), (std::vector<int>{6, 7})) << "not green again";
  EXPECT_EQ(rules.AllowedActions({0, 5, 9, 2}, {}), (std::vector<int>{4, 5})) << "to red and green";
}

// Of a part that is begun anew nothing is stacked; what was finished before it is.
TEST(OneTower, BegunAnewCountsWhatWasFinished) {
  const TaskRules rules = Stacking(6);
  const Attempt first = BegunAnew(rules, {{0, 5}, 6});
  const TaskRules anew = RulesFor(rules, first);
  EXPECT_TRUE(anew.Legal(first.executed, {0, 5, 9, 2, 4, 8})) << "red on green after all";
  EXPECT_FALSE(anew.Legal(first.executed, {0, 5, 9, 2, 7, 11}));
  const Attempt second = BegunAnew(rules, {{0, 5, 9, 2, 4}, 6});
  const TaskRules again = RulesFor(rules, second);
  EXPECT_EQ(again.AllowedActions(second.executed, {3}), (std::vector<int>{4, 5}));
}

TEST(OneTower, GoalsAreBroughtAboutInOneTower) {
  TaskRules rules = Stacking(6);
  SetGoal(TermsOf(ParseGoal("on(red,blue)"), OnFacts(StackingWords(), rules)), &rules);
  EXPECT_TRUE(rules.Legal({}, {2, 5, 9, 0, 6, 10}));
  EXPECT_TRUE(rules.Legal({}, {0, 6, 10, 2, 5, 9})) << "or blue is lifted together with red";
  EXPECT_FALSE(rules.Legal({}, {1, 7, 11, 0, 6, 10})) << "two towers";
  try {
    SetGoal(TermsOf(ParseGoal("on(red,blue),on(green,yellow)"), OnFacts(StackingWords(), rules)),
            &rules);
    ADD_FAILURE() << "these are two towers";
  } catch (const GoalError& error) {
    EXPECT_STREQ(error.what(),
                 "no plan of this task's 6 actions brings about on(red,blue), on(green,yellow) in "
                 "one tower");
  }
  rules = Stacking(9);
  SetGoal(TermsOf(ParseGoal("on(red,blue),on(green,yellow)"), OnFacts(StackingWords(), rules)),
          &rules);
  EXPECT_TRUE(rules.Legal({}, {1, 7, 11, 2, 5, 9, 0, 6, 10}));
}

TEST(OneTower, IsOfTablesThatStackAndOfFewThings) {
  EXPECT_TRUE(OneTower(PickAndPutWords(), PickAndPut(6)).empty())
      << "nothing is said to be stacked";
  EXPECT_TRUE(OneTower(VisitWords(4), AnyOrder(4, 3)).empty());
  const auto with = [](int blocks) {
    std::vector<ActionWords> words;
    TaskRules rules = AnyOrder(2 * blocks, 4, true);
    rules.successors.assign(static_cast<std::size_t>(2 * blocks) + 1, {});
    for (int action = 0; action < 2 * blocks; ++action) {
      words.push_back({action < blocks ? "pick" : "stack", std::to_string(action % blocks)});
      std::vector<int>& row = rules.successors[static_cast<std::size_t>(action)];
      for (int next = 0; next < blocks; ++next) {
        if (next != action) row.push_back(action < blocks ? blocks + next : next);
      }
      if (action < blocks) rules.successors.back().push_back(action);
    }
    rules.tower = OneTower(words, rules);
    rules.Prepare();
    return rules;
  };
  EXPECT_EQ(TowerLevels(with(kMostBlocks)), 3);
  EXPECT_TRUE(with(kMostBlocks + 1).tower.empty());
}

TEST(OneTower, ValidateNamesTheFault) {
  const TaskRules good = Stacking(6);
  for (void (*spoil)(TowerRules*) :
       {+[](TowerRules* t) { t->num_states = 0; }, +[](TowerRules* t) { t->handovers.pop_back(); },
        +[](TowerRules* t) { t->stands.pop_back(); }, +[](TowerRules* t) { t->next.pop_back(); },
        +[](TowerRules* t) { t->next.back() = 999; },
        +[](TowerRules* t) { t->handovers.back() = 999; }}) {
    TaskRules bad = good;
    spoil(&bad.tower);
    EXPECT_THROW(bad.Prepare(), std::invalid_argument);
  }
}

}  // namespace
}  // namespace prospect::planner

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>

#include "planner/evaluation.h"
#include "planner/evaluation_table.h"
#include "planner/path.h"
#include "planner/path_tree.h"
#include "planner/search_parameters.h"
#include "planner/task_rules.h"

namespace prospect::planner {
namespace {

TEST(Path, IsPrintedByItsActions) {
  EXPECT_EQ(ToString(Path{}), "root");
  EXPECT_EQ(ToString(Path{3, 0, 12}), "3-0-12");
}

// The hash crosses process and machine borders: it must never change.
TEST(Path, HashIsFixedAndTellsPathsApart) {
  EXPECT_EQ(HashPath({}), 0xcbf29ce484222325ULL);
  EXPECT_EQ(HashPath({3, 0, 12}), 0x7b4fc0cd3cc2c18eULL);
  EXPECT_EQ(HashCombine(7, 9), 0x5de186dcba779207ULL);
  EXPECT_EQ(HashPath({1, 2}), ExtendHash(ExtendHash(kRootHash, 1), 2));
  std::set<std::uint64_t> seen;
  for (int a = 0; a < 40; ++a) {
    for (int b = 0; b < 40; ++b) {
      seen.insert(HashPath({static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)}));
    }
    seen.insert(HashPath({static_cast<std::uint8_t>(a)}));
  }
  EXPECT_EQ(seen.size(), 1640u);
}

TEST(PathTree, NumbersPathsParentsFirst) {
  PathTree tree(5);
  EXPECT_EQ(tree.Find(Path{}), kRoot);
  const PathId id = tree.Add(Path{4, 0, 3});
  EXPECT_EQ(tree.size(), 4);
  EXPECT_EQ(tree.Add(Path{4, 0, 3}), id);
  EXPECT_EQ(tree.PathOf(id), (Path{4, 0, 3}));
  EXPECT_EQ(tree.depth(id), 3);
  EXPECT_EQ(tree.action(id), 3);
  EXPECT_EQ(tree.hash(id), HashPath({4, 0, 3}));
  EXPECT_LT(tree.parent(id), id);
  EXPECT_EQ(tree.Find(Path{4, 1}), kNoPath);
  EXPECT_EQ(tree.Find(Path{9}), kNoPath);
}

TEST(PathTree, RefusesForeignPaths) {
  EXPECT_THROW(PathTree(0), std::invalid_argument);
  EXPECT_THROW(PathTree(256), std::invalid_argument);
  PathTree tree(5);
  EXPECT_THROW(tree.Add(Path{5}), std::invalid_argument);
  EXPECT_THROW(tree.Add(Path(65, 0)), std::invalid_argument);
  EXPECT_EQ(tree.size(), 1);
}

TEST(TaskRules, MasksWhatWasDoneOrIsOnThePath) {
  const TaskRules rules = AnyOrder(4, 3);
  EXPECT_EQ(rules.AllowedActions({}, {}), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(rules.AllowedActions({2}, {0}), (std::vector<int>{1, 3}));
  EXPECT_FALSE(rules.Complete({2}, {0}));
  EXPECT_TRUE(rules.Complete({2}, {0, 1}));
  EXPECT_TRUE(rules.AllowedActions({2}, {0, 1}).empty());
  EXPECT_TRUE(rules.Legal({2}, {0, 1}));
  EXPECT_FALSE(rules.Legal({2}, {0, 2}));
  EXPECT_FALSE(rules.Legal({2}, {0, 1, 3}));
  EXPECT_FALSE(rules.Allowed({}, {}, 4));
  EXPECT_FALSE(rules.Allowed({}, {}, -1));
}

TEST(TaskRules, FollowsTheSuccessorTable) {
  TaskRules rules;
  rules.num_actions = 3;
  rules.plan_length = 4;
  rules.successors = {{1}, {2}, {0}, {0, 1}};
  rules.repeats_allowed = true;
  rules.Validate();
  EXPECT_EQ(rules.AllowedActions({}, {}), (std::vector<int>{0, 1}));
  EXPECT_EQ(rules.AllowedActions({1}, {}), (std::vector<int>{2}));
  EXPECT_TRUE(rules.Legal({}, {0, 1, 2, 0}));
  rules.repeats_allowed = false;
  EXPECT_FALSE(rules.Legal({}, {0, 1, 2, 0}));
}

// 0 begin, 1 go on, 2 finish; after 1 one may begin anew, too, and after 2 only that.
TaskRules BeginGoOnFinish(int plan_length) {
  TaskRules rules;
  rules.num_actions = 3;
  rules.plan_length = plan_length;
  rules.successors = {{1}, {0, 2}, {0}, {0}};
  rules.repeats_allowed = true;
  rules.Prepare();
  return rules;
}

TEST(TaskRules, APlanEndsWhereOneBeginsAnew) {
  const TaskRules rules = BeginGoOnFinish(3);
  EXPECT_EQ(rules.AllowedActions({0, 1}, {}), (std::vector<int>{2})) << "not to begin anew";
  EXPECT_TRUE(rules.Legal({}, {0, 1, 2}));
  EXPECT_FALSE(rules.Legal({}, {0, 1, 0}));
  const TaskRules longer = BeginGoOnFinish(5);
  EXPECT_EQ(longer.AllowedActions({}, {0, 1}), (std::vector<int>{0})) << "five, by a second try";
  EXPECT_TRUE(longer.Legal({}, {0, 1, 0, 1, 2}));
}

TEST(TaskRules, WhereAPlanCannotEndAnyMoreTheTableDecides) {
  const TaskRules rules = BeginGoOnFinish(3);
  EXPECT_EQ(rules.AllowedActions({0, 1, 2}, {}), (std::vector<int>{})) << "complete";
  EXPECT_EQ(rules.AllowedActions({2, 0}, {}), (std::vector<int>{1}));
  EXPECT_EQ(rules.AllowedActions({1}, {0}), (std::vector<int>{1}));
}

TEST(TaskRules, InAnyOrderEveryActionEndsAPlan) {
  const TaskRules rules = AnyOrder(4, 3);
  for (const std::vector<bool>& row : rules.finishes) {
    EXPECT_EQ(row, std::vector<bool>(4, true));
  }
}

// One decides an action, the other lists them: on random tables they must say the same.
TEST(TaskRules, DecidesWhatItLists) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    TaskRules rules = AnyOrder(6, 1 + round % 6, round % 2 == 0);
    for (auto& row : rules.successors) {
      row.erase(std::remove_if(row.begin(), row.end(), [&](int) { return random() % 3 == 0; }),
                row.end());
    }
    if (round % 3 > 0) rules.Prepare();
    if (round % 3 == 0) rules.finishes.clear();
    const Path executed(random() % 2, static_cast<std::uint8_t>(random() % 6));
    Path path;
    while (path.size() < 6) {
      const std::vector<int> listed = rules.AllowedActions(executed, path);
      for (int action = -1; action <= 6; ++action) {
        const bool allowed = std::count(listed.begin(), listed.end(), action) > 0;
        EXPECT_EQ(rules.Allowed(executed, path, action), allowed)
            << ToString(path) << " then " << action << ", round " << round;
      }
      EXPECT_TRUE(rules.Legal(executed, path));
      if (listed.empty()) break;
      path.push_back(static_cast<std::uint8_t>(listed[random() % listed.size()]));
    }
  }
}

// Facts that random transitions set and clear, of which some must hold at the end.
void AddRandomGoal(std::mt19937& random, TaskRules* rules) {
  GoalRules& goal = rules->goal;
  goal.num_facts = 1 + static_cast<int>(random() % 4);
  const unsigned facts = (1u << goal.num_facts) - 1;
  const auto bits = [&] {
    return static_cast<std::uint8_t>(random() & random() & facts);  // NOLINT: two draws, a quarter
  };
  for (int i = 0; i < rules->num_actions * (rules->num_actions + 1); ++i)
    goal.effects.push_back({bits(), bits()});
  for (unsigned n = 1 + random() % 2; n > 0; --n)
    goal.required.push_back(static_cast<std::uint8_t>(1 + random() % facts));
  rules->Prepare();
}

// Whether a plan of the table can go on from here to an end with the goal met, by trying.
bool CanBringAbout(const TaskRules& rules, const Path& path) {
  if (rules.Complete({}, path)) return rules.finishes[0][path.back()] && rules.GoalMet({}, path);
  const int latest = path.empty() ? rules.num_actions : path.back();
  for (const int action : rules.successors[static_cast<std::size_t>(latest)]) {
    const bool taken = std::count(path.begin(), path.end(), action) > 0;
    Path longer = path;
    longer.push_back(static_cast<std::uint8_t>(action));
    if ((rules.repeats_allowed || !taken) && CanBringAbout(rules, longer)) return true;
  }
  return false;
}

// Whether `action` is a step of the table after `path`, one that leads to a plan with the goal.
bool ShouldBeAllowed(const TaskRules& rules, const Path& path, int action) {
  const int latest = path.empty() ? rules.num_actions : path.back();
  const auto& row = rules.successors[static_cast<std::size_t>(latest)];
  const bool taken = std::count(path.begin(), path.end(), action) > 0;
  if (std::count(row.begin(), row.end(), action) == 0) return false;
  Path longer = path;
  longer.push_back(static_cast<std::uint8_t>(action));
  return (rules.repeats_allowed || !taken) && CanBringAbout(rules, longer);
}

TaskRules RandomRulesWithGoal(std::mt19937& random, int round) {
  TaskRules rules = AnyOrder(5, 1 + round % 5, round % 3 != 0);
  for (auto& row : rules.successors) {
    row.erase(std::remove_if(row.begin(), row.end(), [&](int) { return random() % 3 == 0; }),
              row.end());
  }
  AddRandomGoal(random, &rules);
  return rules;
}

// On random tables and goals: allowed is what leads to a plan with the goal, and where repeats are
// not, at least that.
TEST(TaskRules, AllowsWhatLeadsToTheGoal) {
  std::mt19937 random(11);
  int allowed_steps = 0, refused_steps = 0, plans = 0;
  for (int round = 0; round < 600; ++round) {
    const TaskRules rules = RandomRulesWithGoal(random, round);
    Path path;
    while (!rules.Complete({}, path)) {
      const std::vector<int> listed = rules.AllowedActions({}, path);
      for (int action = -1; action <= 5; ++action) {
        const bool allowed = std::count(listed.begin(), listed.end(), action) > 0;
        const bool should = ShouldBeAllowed(rules, path, action);
        EXPECT_EQ(rules.Allowed({}, path, action), allowed);
        EXPECT_TRUE(should ? allowed : !allowed || !rules.repeats_allowed)
            << ToString(path) << " then " << action << ", round " << round;
        ++(allowed ? allowed_steps : refused_steps);
      }
      if (listed.empty()) break;
      path.push_back(static_cast<std::uint8_t>(listed[random() % listed.size()]));
      EXPECT_TRUE(rules.Legal({}, path));
      EXPECT_TRUE(rules.Legal({path.front()}, Path(path.begin() + 1, path.end())));
    }
    plans += rules.Complete({}, path);
    EXPECT_TRUE(!rules.Complete({}, path) || rules.GoalMet({}, path)) << ToString(path);
  }
  EXPECT_GT(allowed_steps, 500);
  EXPECT_GT(refused_steps, 500);
  EXPECT_GT(plans, 200);
}

TEST(TaskRules, ValidateNamesTheFault) {
  TaskRules rules = AnyOrder(3, 2);
  rules.successors.pop_back();
  EXPECT_THROW(rules.Validate(), std::invalid_argument);
  rules = AnyOrder(3, 2);
  rules.successors[0].push_back(3);
  EXPECT_THROW(rules.Validate(), std::invalid_argument);
  rules = AnyOrder(3, 2);
  rules.goal.required = {1};
  EXPECT_THROW(rules.Validate(), std::invalid_argument) << "a goal without facts";
  rules.goal.num_facts = 1;
  EXPECT_THROW(rules.Prepare(), std::invalid_argument) << "and without effects";
  EXPECT_THROW(AnyOrder(3, 65), std::invalid_argument);
  EXPECT_THROW(AnyOrder(0, 2), std::invalid_argument);
}

TEST(SearchParameters, ValidateChecksRanges) {
  SearchParameters good;
  EXPECT_NO_THROW(good.Validate());
  for (void (*spoil)(SearchParameters*) :
       {+[](SearchParameters* p) { p->c = 0; }, +[](SearchParameters* p) { p->c_done = 1.1; },
        +[](SearchParameters* p) { p->p_min = std::numeric_limits<double>::quiet_NaN(); },
        +[](SearchParameters* p) { p->samples = 0; }, +[](SearchParameters* p) { p->depth = 65; },
        +[](SearchParameters* p) { p->rule = "uct"; }}) {
    SearchParameters bad;
    spoil(&bad);
    EXPECT_THROW(bad.Validate(), std::invalid_argument);
  }
}

TEST(Evaluation, QuantisationRoundTrips) {
  for (int n = 0; n <= 65535; ++n) {
    ASSERT_EQ(Quantize(Dequantize(static_cast<std::uint16_t>(n))), n);
  }
  for (float x = 0; x <= 1; x += 0.00037f) {
    ASSERT_NEAR(Dequantize(Quantize(x)), x, 1.0 / 131070 + 1e-7);
  }
  EXPECT_EQ(Quantize(-1.0f), 0);
  EXPECT_EQ(Quantize(2.0f), 65535);
  EXPECT_EQ(Quantize(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(Evaluation, AsOnTheWireIsIdempotent) {
  const Evaluation raw{0.3f, 0.7f, {0.123f, 0.9f}, {0.01f, 0.5f}};
  const Evaluation once = AsOnTheWire(raw);
  const Evaluation twice = AsOnTheWire(once);
  EXPECT_EQ(once.q, twice.q);
  EXPECT_EQ(once.p, twice.p);
  EXPECT_EQ(once.value, raw.value);
  EXPECT_NE(once.q, raw.q);
}

TEST(Evaluation, DefectFindsBadNumbers) {
  const Evaluation good{0.3f, 0.7f, {0, 1}, {1, 0}};
  EXPECT_STREQ(Defect(good, 2), "");
  EXPECT_STRNE(Defect(good, 3), "");
  for (const float bad : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity()}) {
    Evaluation spoilt = good;
    spoilt.value = bad;
    EXPECT_STRNE(Defect(spoilt, 2), "");
    spoilt = good;
    spoilt.done = bad;
    EXPECT_STRNE(Defect(spoilt, 2), "");
    spoilt = good;
    spoilt.q[1] = bad;
    EXPECT_STRNE(Defect(spoilt, 2), "");
    spoilt = good;
    spoilt.p[0] = bad;
    EXPECT_STRNE(Defect(spoilt, 2), "");
  }
}

TEST(EvaluationTable, KeepsTheLowerOfTwoInEitherOrder) {
  const Evaluation low{0.3f, 0.5f, {0.25f}, {1}};
  const Evaluation high{0.4f, 0.6f, {0.75f}, {1}};
  for (const bool low_first : {true, false}) {
    PathTree tree(1);
    EvaluationTable table(&tree);
    EXPECT_EQ(table.Put(kRoot, low_first ? low : high, 7), Stored::kNew);
    EXPECT_EQ(table.Put(kRoot, low_first ? high : low, 7),
              low_first ? Stored::kDuplicate : Stored::kReplaced);
    EXPECT_EQ(table.value(kRoot), 0.3f);
    EXPECT_EQ(table.done(kRoot), 0.5f);
    EXPECT_EQ(table.q(kRoot)[0], Dequantize(Quantize(0.25f)));
    EXPECT_EQ(table.size(), 1);
    // The fingerprint decides before V.
    EXPECT_EQ(table.Put(kRoot, high, 6), Stored::kReplaced);
    EXPECT_EQ(table.value(kRoot), 0.4f);
    EXPECT_EQ(table.Put(kRoot, low, 7), Stored::kDuplicate);
  }
}

}  // namespace
}  // namespace prospect::planner

#include "agent/goal.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

namespace prospect::agent {
namespace {

// Three objects, two legs.
TaskView VisitTask() {
  TaskView task;
  task.words = {{"investigate", "barrel"}, {"investigate", "pylon"}, {"investigate", "rock"}};
  task.rules = planner::AnyOrder(3, 2);
  task.goals = {{"visited", {"barrel"}, {{-1, 0}}, {}},
                {"visited", {"pylon"}, {{-1, 1}}, {}},
                {"visited", {"rock"}, {{-1, 2}}, {}}};
  return task;
}

SceneLabel Present(std::vector<bool> present) { return {0, std::move(present)}; }

TEST(EpisodeGoal, NoneAsksNothing) {
  const EpisodeGoal none("");
  EXPECT_TRUE(none.empty());
  EXPECT_TRUE(none.Atoms().empty());
  EXPECT_EQ(none.Defect(VisitTask(), Present({false, false, false})), "");
  EXPECT_TRUE(none.Reached(VisitTask(), {}));
  EXPECT_THROW(EpisodeGoal("visited("), std::invalid_argument);
}

TEST(EpisodeGoal, IsReachedByWhatWasCarriedOut) {
  const EpisodeGoal goal("visited(pylon,barrel)");
  EXPECT_EQ(goal.Atoms(), std::vector<std::string>{"visited(pylon,barrel)"});
  EXPECT_EQ(goal.AtomsOf(VisitTask()),
            (std::vector<std::string>{"visited(pylon)", "visited(barrel)"}));
  EXPECT_TRUE(goal.Reached(VisitTask(), {0, 1}));
  EXPECT_TRUE(goal.Reached(VisitTask(), {1, 0}));
  EXPECT_FALSE(goal.Reached(VisitTask(), {1, 2}));
  EXPECT_FALSE(goal.Reached(VisitTask(), {}));
}

TEST(EpisodeGoal, SaysWhatTaskAndSceneCannotHave) {
  const EpisodeGoal goal("visited(pylon,barrel)");
  EXPECT_EQ(goal.Defect(VisitTask(), std::nullopt), "");
  EXPECT_EQ(goal.Defect(VisitTask(), Present({true, true, false})), "");
  EXPECT_EQ(goal.Defect(VisitTask(), Present({true, false, true})),
            "there is no pylon in this scene; there are: barrel, rock");
  EXPECT_EQ(EpisodeGoal("visited(tree)").Defect(VisitTask(), std::nullopt),
            "there is no 'tree' in this task; there are: barrel, pylon, rock");
  EXPECT_NE(EpisodeGoal("visited(barrel,pylon,rock)").Defect(VisitTask(), std::nullopt), "");
  EXPECT_NE(EpisodeGoal("on(barrel,pylon)").Defect(VisitTask(), std::nullopt), "");
}

}  // namespace
}  // namespace prospect::agent

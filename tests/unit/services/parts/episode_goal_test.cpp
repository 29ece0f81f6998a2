#include "services/executive/episode_goal.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace prospect::services {
namespace {

// Three objects, two legs.
task_t VisitTask() {
  task_t task{};
  task.num_actions = 3;
  task.plan_length = 2;
  for (const char* object : {"barrel", "pylon", "rock"}) {
    action_t action{};
    action.index = static_cast<std::int32_t>(task.actions.size());
    action.kind = "investigate";
    action.object = object;
    action.successors = {0, 1, 2};
    action.num_successors = 3;
    task.actions.push_back(action);
  }
  task.initial = {0, 1, 2};
  task.num_initial = 3;
  return task;
}

label_t Present(std::vector<std::uint8_t> present) {
  label_t label{};
  label.present = std::move(present);
  return label;
}

TEST(EpisodeGoal, NoneAsksNothing) {
  const EpisodeGoal none("");
  EXPECT_TRUE(none.empty());
  EXPECT_TRUE(none.Atoms().empty());
  EXPECT_EQ(none.Defect(VisitTask(), Present({0, 0, 0})), "");
  EXPECT_TRUE(none.Reached(VisitTask(), {}));
  EXPECT_THROW(EpisodeGoal("visited("), std::invalid_argument);
}

TEST(EpisodeGoal, IsReachedByWhatWasCarriedOut) {
  const EpisodeGoal goal("visited(pylon,barrel)");
  EXPECT_EQ(goal.Atoms(), (std::vector<std::string>{"visited(pylon)", "visited(barrel)"}));
  EXPECT_TRUE(goal.Reached(VisitTask(), {0, 1}));
  EXPECT_TRUE(goal.Reached(VisitTask(), {1, 0}));
  EXPECT_FALSE(goal.Reached(VisitTask(), {1, 2}));
  EXPECT_FALSE(goal.Reached(VisitTask(), {}));
}

TEST(EpisodeGoal, SaysWhatTaskAndSceneCannotHave) {
  const EpisodeGoal goal("visited(pylon,barrel)");
  EXPECT_EQ(goal.Defect(VisitTask(), std::nullopt), "");
  EXPECT_EQ(goal.Defect(VisitTask(), Present({1, 1, 0})), "");
  EXPECT_EQ(goal.Defect(VisitTask(), Present({1, 0, 1})),
            "there is no pylon in this scene; there are: barrel, rock");
  EXPECT_EQ(EpisodeGoal("visited(tree)").Defect(VisitTask(), std::nullopt),
            "there is no 'tree' in this task; there are: barrel, pylon, rock");
  EXPECT_NE(EpisodeGoal("visited(barrel,pylon,rock)").Defect(VisitTask(), std::nullopt), "");
  EXPECT_NE(EpisodeGoal("on(barrel,pylon)").Defect(VisitTask(), std::nullopt), "");
}

}  // namespace
}  // namespace prospect::services

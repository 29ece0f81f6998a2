// The files of tasks/ beside the built-in worlds that they describe.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "sim/task_factory.h"
#include "tasks/plan_check.h"
#include "tasks/task_folder.h"

namespace prospect::tasks {
namespace {

const TaskFolder& Folder() {
  static const TaskFolder folder(PROSPECT_ROOT "/tasks");
  return folder;
}

void ExpectSame(const TaskFile& file, const sim::TaskSpec& world) {
  const sim::TaskSpec& spec = file.spec;
  ASSERT_EQ(spec.actions.size(), world.actions.size());
  for (std::size_t i = 0; i < spec.actions.size(); ++i) {
    EXPECT_EQ(spec.actions[i].index, world.actions[i].index);
    EXPECT_EQ(spec.actions[i].name, world.actions[i].name);
    EXPECT_EQ(spec.actions[i].kind, world.actions[i].kind);
    EXPECT_EQ(spec.actions[i].object, world.actions[i].object);
  }
  EXPECT_EQ(spec.successors, world.successors);
  EXPECT_EQ(spec.repeats_allowed, world.repeats_allowed);
  EXPECT_EQ(spec.image_width, world.image_width);
  EXPECT_EQ(spec.image_height, world.image_height);
  EXPECT_NEAR(spec.tick_seconds, world.tick_seconds, 1e-6);
  EXPECT_EQ(spec.Hash(), world.Hash());
  ASSERT_EQ(spec.causes.size(), world.causes.size());
  for (std::size_t i = 0; i < spec.causes.size(); ++i) {
    EXPECT_EQ(spec.causes[i].name, world.causes[i].name);
    EXPECT_EQ(spec.causes[i].words, world.causes[i].words);
  }
}

TEST(BuiltInTasks, EachWorldIsWhatItsFileSays) {
  for (const std::string& name : sim::TaskNames()) {
    SCOPED_TRACE(name);
    const TaskFile* file = Folder().Find(name);
    ASSERT_NE(file, nullptr);
    ASSERT_TRUE(file->simulator);
    const auto world = sim::MakeTask(name);
    ExpectSame(*file, world->spec());
    EXPECT_EQ(file->spec.plan_length, world->spec().plan_length);
    EXPECT_EQ(file->spec.action_time_limit, world->spec().action_time_limit);
  }
}

TEST(BuiltInTasks, ScenesOfAllLengths) {
  for (const char* name : {"navigation", "stacking"}) {
    const TaskFile& file = *Folder().Find(name);
    ASSERT_EQ(file.plan_lengths.size(), 3u);
    for (std::size_t i = 0; i < file.plan_lengths.size(); ++i) {
      sim::TaskOptions options;
      options.objects = 5;
      sim::SetPlanLength(name, file.plan_lengths[i], &options);
      const sim::TaskSpec world = sim::MakeTask(name, options)->spec();
      EXPECT_EQ(world.plan_length, file.plan_lengths[i]);
      EXPECT_EQ(world.action_time_limit, file.time_limits[i]);
    }
  }
}

TEST(BuiltInTasks, UsualScenesAreTheWorldsOwn) {
  const sim::TaskOptions usual;
  EXPECT_EQ(Folder().Find("navigation")->simulator->scene.at("objects"), usual.objects);
  EXPECT_EQ(Folder().Find("navigation")->simulator->scene.at("legs"), usual.legs);
  EXPECT_EQ(Folder().Find("stacking")->simulator->scene.at("tower"), usual.tower);
}

TEST(BuiltInTasks, NoFileHasAWorldThatIsNotThere) {
  std::size_t worlds = 0;
  for (const TaskFile& task : Folder().All()) worlds += task.simulator.has_value();
  EXPECT_EQ(worlds, sim::TaskNames().size());
  EXPECT_EQ(Folder().All().size(), 5u);
}

TEST(BuiltInTasks, GoalsAreThoseOfTheTable) {
  const TaskFile& navigation = *Folder().Find("navigation");
  ASSERT_EQ(navigation.goals.size(), 7u);
  EXPECT_EQ(navigation.goals[2], (planner::GoalFact{"visited", {"pylon"}, {{-1, 2}}, {}}));
  const TaskFile& stacking = *Folder().Find("stacking");
  ASSERT_EQ(stacking.goals.size(), 12u);  // a block on each of the others
  const planner::GoalFact on{"on", {"red", "blue"}, {{12, 17}}, {{12, 18}, {12, 19}}};
  EXPECT_EQ(stacking.goals[0], on);
  EXPECT_TRUE(Folder().Find("suturing")->goals.empty());
}

TEST(BuiltInTasks, WhatIsNeverReachedIsKnown) {
  EXPECT_TRUE(NeverReached(Folder().Find("stacking")->spec).empty());
  EXPECT_EQ(NeverReached(Folder().Find("suturing")->spec), (std::vector<int>{6, 11, 12, 13, 14}));
}

TEST(BuiltInTasks, TheExampleOfTheDocsIsATask) {
  std::ifstream page(PROSPECT_ROOT "/docs/task-files.md");
  std::ostringstream text;
  text << page.rdbuf();
  const std::string fence = "```yaml\n";
  const std::size_t begin = text.str().find(fence) + fence.size();
  const std::string example = text.str().substr(begin, text.str().find("```", begin) - begin);
  const TaskFile task = ParseTaskFile(example, "docs/task-files.md");
  EXPECT_EQ(task.spec.name, "sorter");
  EXPECT_TRUE(NeverReached(task.spec).empty());
}

TEST(BuiltInTasks, TheExampleRobotsHaveAFileToo) {
  const TaskFile task = ReadTaskFile(PROSPECT_ROOT "/examples/robots/sorting.yaml");
  EXPECT_EQ(task.spec.actions.size(), 12u);
  ASSERT_EQ(task.goals.size(), 12u);  // a block in a bin
  EXPECT_EQ(task.goals[0], (planner::GoalFact{"in", {"red", "left_bin"}, {{0, 8}}, {}}));
  EXPECT_EQ(task.goals[1].brought_by, (std::vector<planner::GoalStep>{{0, 9}, {4, 10}}));
}

}  // namespace
}  // namespace prospect::tasks

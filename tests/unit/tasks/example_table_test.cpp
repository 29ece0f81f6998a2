// The example's task file beside the table that its robot says.

#include <gtest/gtest.h>

#include "examples/robots/cpp/world.h"
#include "tasks/task_file.h"

namespace prospect::tasks {
namespace {

TEST(ExampleTable, IsTheRobots) {
  const TaskFile file = ReadTaskFile(PROSPECT_ROOT "/examples/robots/sorting.yaml");
  const sim::TaskSpec& spec = file.spec;
  EXPECT_EQ(spec.name, "sorting");
  ASSERT_EQ(spec.actions.size(), sorting::kActions.size());
  for (std::size_t i = 0; i < spec.actions.size(); ++i) {
    const sorting::Action& action = sorting::kActions[i];
    EXPECT_EQ(spec.actions[i].kind, Kind(action));
    EXPECT_EQ(spec.actions[i].object, Thing(action));
    EXPECT_EQ(spec.actions[i].name, Kind(action) + "(" + Thing(action) + ")");
    EXPECT_EQ(spec.successors[i], action.take ? sorting::kPuts[action.side] : sorting::kTakes);
  }
  EXPECT_EQ(spec.successors.back(), sorting::kTakes);
  EXPECT_EQ(spec.plan_length, sorting::kPlanLength);
  EXPECT_FALSE(spec.repeats_allowed);
  EXPECT_EQ(spec.image_width, sorting::kPixels);
  EXPECT_EQ(spec.image_height, sorting::kPixels);
  ASSERT_EQ(spec.causes.size(), std::size(sorting::kCauses));
  for (std::size_t i = 0; i < spec.causes.size(); ++i) {
    EXPECT_EQ(spec.causes[i].name, sorting::kCauses[i].first);
    EXPECT_EQ(spec.causes[i].words, sorting::kCauses[i].second);
  }
}

}  // namespace
}  // namespace prospect::tasks

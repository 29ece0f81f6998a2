#include "model/training/recipe.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace prospect::model {
namespace {

using nlohmann::json;

const char* const kTasks[] = {"navigation", "stacking", "suturing"};

TEST(Recipe, BestIsTheTasksOwn) {
  for (const char* task : kTasks) {
    TrainConfig config = TrainConfigFor(task);
    ApplyRecipe("best", &config);
    EXPECT_EQ(json(config), json(TrainConfigFor(task)));
  }
}

TEST(Recipe, PaperIsAllStepsLeftOutAndTrainsTAsOften) {
  for (const char* task : kTasks) {
    const TrainConfig own = TrainConfigFor(task);
    TrainConfig paper = own, one_by_one = own;
    ApplyRecipe("paper", &paper);
    for (const RecipeStep& step : RecipeSteps()) LeaveOut(step.name, &one_by_one);
    EXPECT_EQ(json(paper), json(one_by_one));
    Validate(paper);
    EXPECT_EQ(paper.transform_hidden.iterations, 0);
    EXPECT_EQ(paper.transform_image.iterations,
              own.transform_image.iterations + own.transform_hidden.iterations);
    EXPECT_EQ(paper.augment, "none");
    EXPECT_LE(paper.linked_steps, 2);
    EXPECT_EQ(paper.linked_from, 0);
    EXPECT_EQ(paper.network.transform_action, "bottleneck");
    EXPECT_FALSE(paper.network.transform_mask);
    for (const double beyond : {paper.focus, paper.landmark_weight, paper.gain_weight,
                                paper.done_weight, paper.imagined_share})
      EXPECT_EQ(beyond, 0);
    EXPECT_FALSE(paper.compose);
    EXPECT_EQ(paper.picture_weight, 1);
  }
}

// A step that changes no task's configuration would be a name without a thing.
TEST(Recipe, EveryStepIsTakenBySomeConfigurationAndLeavingItOutTwiceIsOnce) {
  TrainConfig all = TrainConfigFor("navigation");
  all.picture_weight = 100, all.gain_weight = 0.1, all.inside_weight = 0.1, all.linked_from = 1;
  all.network.transform_action = "scale_and_shift", all.network.transform_mask = true;
  for (const RecipeStep& step : RecipeSteps()) {
    TrainConfig config = all;
    LeaveOut(step.name, &config);
    EXPECT_NE(json(config), json(all)) << step.name;
    const json once = config;
    LeaveOut(step.name, &config);
    EXPECT_EQ(json(config), once) << step.name;
  }
}

TEST(Recipe, UnknownNamesSayWhatIsKnown) {
  TrainConfig config;
  EXPECT_THROW(ApplyRecipe("good", &config), std::invalid_argument);
  try {
    LeaveOut("nothing", &config);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("known are views, focus"), std::string::npos);
  }
}

}  // namespace
}  // namespace prospect::model

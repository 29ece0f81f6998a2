#include "model/training/recipe.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "cli/commands/train.h"
#include "model/training/config_choices.h"
#include "model/training/variants.h"
#include "tests/unit/model/task_config.h"

namespace prospect::model {
namespace {

using nlohmann::json;

const char* const kTasks[] = {"navigation", "stacking", "suturing"};

TEST(Recipe, PaperIsAllStepsLeftOutAndTrainsTAsOften) {
  for (const char* task : kTasks) {
    const TrainConfig own = TrainConfigFor(task);
    TrainConfig paper = own, one_by_one = own;
    LeaveOutAll(&paper);
    for (const std::string& step : RecipeSteps()) LeaveOut(step, &one_by_one);
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
  for (const std::string& step : RecipeSteps()) {
    TrainConfig config = all;
    LeaveOut(step, &config);
    EXPECT_NE(json(config), json(all)) << step;
    const json once = config;
    LeaveOut(step, &config);
    EXPECT_EQ(json(config), once) << step;
  }
}

// What the command line explains is what there is.
TEST(Recipe, TheCommandLineKnowsEveryStepAndVariant) {
  EXPECT_EQ(cli::RecipeStepNames(), RecipeSteps());
  std::vector<std::string> variants;
  for (const Variant& variant : Variants()) variants.push_back(variant.name);
  EXPECT_EQ(cli::VariantNames(), variants);
}

TEST(Recipe, UnknownNamesSayWhatIsKnown) {
  TrainConfig config;
  try {
    LeaveOut("nothing", &config);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("known are views, focus"), std::string::npos);
  }
}

std::string VariantName(std::size_t i) { return i == 0 ? "" : Variants()[i - 1].name; }

// What came of one meeting of choices: refused in words, or numbers all of which are finite.
void ExpectSoundOrRefused(const ConfigChoices& choices, int* sound) {
  TrainConfig config;
  try {
    config = ConfigOf(choices);
  } catch (const std::invalid_argument& error) {
    EXPECT_STRNE(error.what(), "");
    return;
  }
  ++*sound;
  const std::string text = json(config).dump();
  EXPECT_EQ(text.find("null"), std::string::npos)
      << choices.changes << choices.variant << " without "
      << (choices.without.empty() ? "" : choices.without.front()) << ": " << text;
}

TEST(ConfigChoices, WhicheverMeetEveryNumberIsFiniteAndInRange) {
  const char* const changes[] = {
      "{}",
      R"({"picture_weight": 0})",
      R"({"picture_weight": 1e-300})",
      R"({"picture_weight": 1e-300, "lambda": 0})",
      R"({"picture_weight": 1000000})",
      R"({"lambda": 1000000, "judge_steps": 1000})",
      R"({"transform_image": {"iterations": 1000000000, "batch": 8, "learning_rate": 0.001}})"};
  int sound = 0;
  for (const char* task : kTasks) {
    const TrainConfig own = TrainConfigFor(task);
    for (const char* change : changes) {
      for (std::size_t variant = 0; variant <= Variants().size(); ++variant) {
        for (std::size_t step = 0; step <= RecipeSteps().size(); ++step) {
          ConfigChoices choices;
          choices.task = own;
          choices.changes = json::parse(change);
          choices.variant = VariantName(variant);
          if (step > 0) choices.without = {RecipeSteps()[step - 1]};
          for (const std::int64_t iterations :
               {0L, 1L, 1'000'000'000L, 9'000'000'000'000'000'000L}) {
            choices.iterations = iterations;
            for (const bool paper : {false, true}) {
              choices.paper = paper;
              ExpectSoundOrRefused(choices, &sound);
            }
          }
        }
      }
    }
  }
  EXPECT_GT(sound, 5000);
}

TEST(ConfigChoices, WithoutPicturesALossWithoutPicturesKeepsItsWeightOfC) {
  ConfigChoices choices;
  choices.task = TrainConfigFor("stacking");
  choices.changes = {{"picture_weight", 0}};
  choices.without = {"pictures"};
  const TrainConfig config = ConfigOf(choices);
  EXPECT_EQ(config.lambda, TrainConfigFor("stacking").lambda);
  EXPECT_EQ(config.picture_weight, 1);
}

}  // namespace
}  // namespace prospect::model

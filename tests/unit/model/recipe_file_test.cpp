#include "model/training/recipe_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "model/weights.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

using nlohmann::json;

const std::string kRoot = PROSPECT_ROOT;

json MetadataOf(const std::string& task) {
  return ReadWeights(kRoot + "/model/weights/" + task + ".safetensors").metadata;
}

// Options that came after these weights were trained have their defaults.
TrainConfig Whole(const json& kept) {
  TrainConfig config;
  kept.get_to(config);
  return config;
}

class BundledRecipe : public testing::TestWithParam<const char*> {
 protected:
  const std::string task = GetParam();
  const RecipeFile recipe = ReadRecipe(kRoot + "/recipes/" + task + ".json");
  const json metadata = MetadataOf(task);
};

TEST_P(BundledRecipe, EndsWithTheRunThatMadeTheBundledWeights) {
  EXPECT_EQ(recipe.task, task);
  EXPECT_EQ(recipe.data_hash, metadata["data_hash"]);
  EXPECT_EQ(json(recipe.runs.back().config), json(Whole(metadata["train"])));
}

// A recipe that leaves options out would change with their defaults.
TEST_P(BundledRecipe, NamesEveryOption) {
  std::ifstream in(kRoot + "/recipes/" + task + ".json");
  const json runs = json::parse(in)["runs"];
  for (std::size_t i = 0; i < runs.size(); ++i)
    EXPECT_EQ(runs[i]["config"], json(recipe.runs[i].config)) << runs[i]["name"];
}

INSTANTIATE_TEST_SUITE_P(Tasks, BundledRecipe,
                         testing::Values("stacking", "navigation", "suturing"));

// Only stacking's weights tell of the runs before the one that made them.
TEST(StackingsRecipe, HasTheRunsOfItsWeightsHistory) {
  const json history = MetadataOf("stacking").at("history");
  const RecipeFile recipe = ReadRecipe(kRoot + "/recipes/stacking.json");
  ASSERT_EQ(recipe.runs.size(), history.size() + 1);
  for (std::size_t i = 0; i < history.size(); ++i) {
    EXPECT_EQ(json(recipe.runs[i].config), json(Whole(history[i]["train"]))) << recipe.runs[i].name;
  }
}

TEST(RecipeFile, WhatIsWrongWithItIsNamed) {
  const TestFolder folder;
  const std::string path = folder / "r.json";
  const auto refused = [&](const std::string& text, const std::string& why) {
    std::ofstream(path) << text;
    try {
      ReadRecipe(path);
      ADD_FAILURE() << text;
    } catch (const std::invalid_argument& error) {
      const std::string said = error.what();
      EXPECT_EQ(said.rfind(path + ": ", 0), 0U) << said;
      EXPECT_NE(said.find(why), std::string::npos) << said;
    }
  };
  refused("{", "is not JSON");
  refused(R"({"task": "stacking"})", "has no runs");
  refused(R"({"runs": [{"name": "a"}]})", "names no task");
  refused(R"({"task": "stacking", "runs": [{"name": "a"}, {"name": "a"}]})", "a name of its own");
  refused(R"({"task": "stacking", "runs": [{"name": "../a"}]})", "a name of its own");
  refused(R"({"task": "stacking", "runs": [{"name": "a", "fron": "b"}]})", "run.fron");
  refused(R"({"task": "stacking", "runs": [{"name": "a", "config": {"lambda": -1}}]})", "lambda");
  refused(R"({"task": "a", "task": "b"})", "twice");
  EXPECT_THROW(ReadRecipe(folder / "absent"), std::invalid_argument);
}

}  // namespace
}  // namespace prospect::model

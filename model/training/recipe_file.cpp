#include "model/training/recipe_file.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "base/strict_json.h"
#include "model/json_fields.h"

namespace prospect::model {
namespace {

using nlohmann::json;

void ReadRun(const json& text, RecipeRun* at) {
  RecipeRun& run = *at;
  JsonFields(text, "run")
      .Read("name", &run.name)
      .Read("why", &run.why)
      .Read("fresh", &run.fresh)
      .Read("config", &run.config)
      .RefuseOthers();
}

RecipeFile RecipeOf(const json& text) {
  RecipeFile recipe;
  json runs = json::array();
  JsonFields(text, "recipe")
      .Read("task", &recipe.task)
      .Read("collect", &recipe.collect)
      .Read("data_hash", &recipe.data_hash)
      .Read("runs", &runs)
      .Read("then", &recipe.then)
      .RefuseOthers();
  for (const json& run : runs) ReadRun(run, &recipe.runs.emplace_back());
  return recipe;
}

// A name is a folder's: of letters, digits and hyphens only.
bool IsName(const std::string& name) {
  return !name.empty() &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
}

void Check(const RecipeFile& recipe) {
  if (recipe.task.empty()) throw std::invalid_argument("names no task");
  if (recipe.runs.empty()) throw std::invalid_argument("has no runs");
  std::set<std::string> names;
  for (const RecipeRun& run : recipe.runs) {
    if (!IsName(run.name) || !names.insert(run.name).second) {
      throw std::invalid_argument("run '" + run.name +
                                  "': each wants a name of its own, of a-z, 0-9 and -");
    }
  }
}

}  // namespace

RecipeFile ReadRecipe(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::invalid_argument(path + ": cannot be read");
  try {
    const json text = base::ParseStrictJson(in);
    if (text.is_discarded()) throw std::invalid_argument("is not JSON");
    RecipeFile recipe = RecipeOf(text);
    Check(recipe);
    return recipe;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(path + ": " + error.what());
  }
}

}  // namespace prospect::model

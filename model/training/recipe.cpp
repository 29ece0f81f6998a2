#include "model/training/recipe.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace prospect::model {
namespace {

struct Entry {
  RecipeStep step;
  std::function<void(TrainConfig*)> leave_out;
};

void WithoutEncodings(TrainConfig* c) {
  c->transform_image.iterations += c->transform_hidden.iterations;
  c->transform_hidden.iterations = 0;
}

const std::vector<Entry>& Entries() {
  static const std::vector<Entry> entries = {
      {{"views", "pictures turned, or as if from other cameras"},
       [](TrainConfig* c) { c->augment = "none", c->hidden_variants = 1; }},
      {{"focus", "pixels that differ from the mean picture weigh more"},
       [](TrainConfig* c) { c->focus = 0; }},
      {{"landmarks", "where things are is read from C, encodings and T's states"},
       [](TrainConfig* c) { c->landmark_weight = 0; }},
      {{"gain", "the decoder paints all pictures in one light"},
       [](TrainConfig* c) { c->gain_weight = 0; }},
      {{"encodings", "T first learns the encodings of the goal pictures; without, pictures only"},
       WithoutEncodings},
      {{"links", "more than two transforms trained one after another"},
       [](TrainConfig* c) {
         c->linked_steps = std::min(c->linked_steps, 2);
         c->linked_from = std::min(c->linked_from, c->linked_steps);
       }},
      {{"growth", "T begins with fewer linked transforms"},
       [](TrainConfig* c) { c->linked_from = 0; }},
      {{"actions", "every layer of T is told the action, not its bottleneck alone"},
       [](TrainConfig* c) { c->network.transform_action = "bottleneck"; }},
      {{"mask", "T keeps numbers of the state it began from where a mask says so"},
       [](TrainConfig* c) { c->network.transform_mask = false; }},
      {{"pictures", "the picture loss of T outweighs landmarks and f"},
       [](TrainConfig* c) {
         if (c->picture_weight > 0) c->lambda /= c->picture_weight;  // else C's weight is its own
         c->picture_weight = 1;
       }},
      {{"done", "a head like f on T's states, passed on to T"},
       [](TrainConfig* c) { c->done_weight = 0; }},
      {{"imagined", "V, Q, p and f learn on imagined states, too"},
       [](TrainConfig* c) { c->imagined_share = 0; }},
      {{"inside", "f's frames shortly before an action ends weigh less"},
       [](TrainConfig* c) { c->inside_weight = 1; }},
      {{"composing", "imagined pictures keep what was seen where nothing changes"},
       [](TrainConfig* c) { c->compose = false; }},
  };
  return entries;
}

}  // namespace

const std::vector<RecipeStep>& RecipeSteps() {
  static const std::vector<RecipeStep> steps = [] {
    std::vector<RecipeStep> all;
    for (const Entry& entry : Entries()) all.push_back(entry.step);
    return all;
  }();
  return steps;
}

void LeaveOut(const std::string& step, TrainConfig* config) {
  std::string known;
  for (const Entry& entry : Entries()) {
    if (entry.step.name == step) return entry.leave_out(config);
    known += (known.empty() ? "" : ", ") + entry.step.name;
  }
  throw std::invalid_argument("step '" + step + "': known are " + known);
}

void ApplyRecipe(const std::string& recipe, TrainConfig* config) {
  if (recipe == "best") return;
  if (recipe != "paper")
    throw std::invalid_argument("recipe '" + recipe + "': known are paper and best");
  for (const Entry& entry : Entries()) entry.leave_out(config);
}

}  // namespace prospect::model

#include "model/training/recipe.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace prospect::model {
namespace {

struct Entry {
  std::string step;
  std::function<void(TrainConfig*)> leave_out;
};

void WithoutEncodings(TrainConfig* c) {
  c->transform_image.iterations += c->transform_hidden.iterations;
  c->transform_hidden.iterations = 0;
}

const std::vector<Entry>& Entries() {
  static const std::vector<Entry> entries = {
      {"views", [](TrainConfig* c) { c->augment = "none", c->hidden_variants = 1; }},
      {"focus", [](TrainConfig* c) { c->focus = 0; }},
      {"landmarks", [](TrainConfig* c) { c->landmark_weight = 0; }},
      {"gain", [](TrainConfig* c) { c->gain_weight = 0; }},
      {"encodings", WithoutEncodings},
      {"links",
       [](TrainConfig* c) {
         c->linked_steps = std::min(c->linked_steps, 2);
         c->linked_from = std::min(c->linked_from, c->linked_steps);
       }},
      {"growth", [](TrainConfig* c) { c->linked_from = 0; }},
      {"actions", [](TrainConfig* c) { c->network.transform_action = "bottleneck"; }},
      {"mask", [](TrainConfig* c) { c->network.transform_mask = false; }},
      {"pictures",
       [](TrainConfig* c) {
         if (c->picture_weight > 0) c->lambda /= c->picture_weight;  // else C's weight is its own
         c->picture_weight = 1;
       }},
      {"done", [](TrainConfig* c) { c->done_weight = 0; }},
      {"imagined", [](TrainConfig* c) { c->imagined_share = 0; }},
      {"inside", [](TrainConfig* c) { c->inside_weight = 1; }},
      {"composing", [](TrainConfig* c) { c->compose = false; }},
  };
  return entries;
}

}  // namespace

const std::vector<std::string>& RecipeSteps() {
  static const std::vector<std::string> steps = [] {
    std::vector<std::string> all;
    for (const Entry& entry : Entries()) all.push_back(entry.step);
    return all;
  }();
  return steps;
}

void LeaveOut(const std::string& step, TrainConfig* config) {
  std::string known;
  for (const Entry& entry : Entries()) {
    if (entry.step == step) return entry.leave_out(config);
    known += (known.empty() ? "" : ", ") + entry.step;
  }
  throw std::invalid_argument("step '" + step + "': known are " + known);
}

void LeaveOutAll(TrainConfig* config) {
  for (const Entry& entry : Entries()) entry.leave_out(config);
}

}  // namespace prospect::model

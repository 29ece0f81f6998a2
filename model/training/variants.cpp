#include "model/training/variants.h"

#include <functional>
#include <stdexcept>

namespace prospect::model {
namespace {

struct Entry {
  Variant variant;
  std::function<void(TrainConfig*)> apply;
};

/// L1 with two linked steps, and so much of C beside a whole L1.
void WithClassifier(double share, TrainConfig* c) {
  c->linked_steps = 2;
  c->lambda = share * c->picture_weight;
}

void Pix2Pix(TrainConfig* c) {
  c->lambda = 0;
  c->adversary = "pix2pix";
  c->picture_weight = 100;
}

void Wasserstein(TrainConfig* c) {
  c->lambda = 0;
  c->adversary = "wgan";
  c->picture_weight = 0.1;
  c->transform_image.iterations *= c->judge_steps + 1;  // T learns in one of so many
}

const std::vector<Entry>& Entries() {
  static const std::vector<Entry> entries = {
      {{"naive", "Naive"}, [](TrainConfig* c) { c->lambda = 0, c->linked_steps = 1; }},
      {{"l1", "L1"}, [](TrainConfig* c) { c->lambda = 0, c->linked_steps = 2; }},
      {{"l1+0.01c", "L1+0.01C"}, [](TrainConfig* c) { WithClassifier(0.01, c); }},
      {{"l1+0.001c", "L1+0.001C"}, [](TrainConfig* c) { WithClassifier(0.001, c); }},
      {{"no-skips", "No Skips"},
       [](TrainConfig* c) { WithClassifier(0.001, c), c->network.skip = false; }},
      {{"cgan", "cGAN"}, [](TrainConfig* c) { c->linked_steps = 2, Pix2Pix(c); }},
      {{"wgan", "WGAN"}, [](TrainConfig* c) { c->linked_steps = 2, Wasserstein(c); }},
      {{"u-net", "U-net"},
       [](TrainConfig* c) { WithClassifier(0.001, c), c->network.bottleneck = "strided"; }},
  };
  return entries;
}

}  // namespace

const std::vector<Variant>& Variants() {
  static const std::vector<Variant> variants = [] {
    std::vector<Variant> all;
    for (const Entry& entry : Entries()) all.push_back(entry.variant);
    return all;
  }();
  return variants;
}

void ApplyVariant(const std::string& name, TrainConfig* config) {
  std::string known;
  for (const Entry& entry : Entries()) {
    if (entry.variant.name == name) return entry.apply(config);
    known += (known.empty() ? "" : ", ") + entry.variant.name;
  }
  throw std::invalid_argument("variant '" + name + "': known are " + known);
}

}  // namespace prospect::model

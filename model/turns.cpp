#include "model/turns.h"

#include "model/weights_error.h"
#include "model/weights_file.h"

namespace prospect::model {
namespace {

using nlohmann::json;

int TurnsIn(const WeightsFile& file, const std::string& path) {
  const json stored = file.metadata.value("turns", json(1));
  if (!stored.is_number_integer() || stored < 1 || stored > kMostTurns) {
    throw WeightsError(path + ": its turns are " + stored.dump() + ", where 1 to " +
                       std::to_string(kMostTurns) + " are expected");
  }
  return stored.get<int>();
}

// Networks that saw every trial turned and mirrored (TrainConfig::augment) say of all eight alike.
bool LearnedTurned(const WeightsFile& file) {
  const json train = file.metadata.value("train", json::object());
  return train.is_object() && train.value("augment", json()) == "dihedral";
}

}  // namespace

int TurnsOf(const std::string& weights_path) {
  return TurnsIn(ReadWeights(weights_path), weights_path);
}

void StoreTurns(const std::string& weights_path, int turns) {
  WeightsFile file = ReadWeights(weights_path);
  if (TurnsIn(file, weights_path) == turns) return;
  if (!LearnedTurned(file)) {
    throw WeightsError(weights_path +
                       ": was not trained on turned pictures (augment: dihedral), so what it says "
                       "of turned ones means nothing");
  }
  file.metadata["turns"] = turns;
  file.metadata.erase("calibration");
  WriteWeights(weights_path, file.tensors, file.metadata);
}

}  // namespace prospect::model

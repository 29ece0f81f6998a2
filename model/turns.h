#pragma once

#include <string>

namespace prospect::model {

/// A square has so many turns and mirrorings.
inline constexpr int kMostTurns = 8;

/// In how many of its turns and mirrorings each picture is looked at by those who decide: the
/// weights file's own number, 1 where it says none (model/turning_engine.h). Throws WeightsError
/// (model/weights_error.h).
int TurnsOf(const std::string& weights_path);

/// Rewrites the weights file with another number, 1 to kMostTurns: same tensors, atomically. What
/// it was calibrated to refuse goes, since scores change; what known pictures look like stays.
/// Nothing is done where the file has this number. Throws WeightsError, also where the networks
/// were not trained on turned pictures.
void StoreTurns(const std::string& weights_path, int turns);

}  // namespace prospect::model

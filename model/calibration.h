#pragma once

#include <string>

namespace prospect::model {

/// How a refusal threshold was found; stored with it in the weights' metadata.
struct Calibration {
  double refusal_threshold = 0;  ///< plans that score below it are to be refused, 0..1
  double alpha = 0;              ///< share of solvable scenes that it may refuse
  int scenes = 0;                ///< solvable calibration scenes it was taken from
  std::string command;           ///< that found it
};

/// Rewrites the weights file with this calibration: same tensors, atomically. The weights' hash
/// changes, since it is over the whole file. Throws WeightsError (model/weights_error.h).
void StoreCalibration(const std::string& weights_path, const Calibration& calibration);

}  // namespace prospect::model

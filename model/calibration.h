#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/refusal/sample.h"

namespace prospect::model {

struct WeightsFile;  // model/weights_file.h

/// How the refusal threshold for one kind of scenes was found; stored with it in the weights'
/// metadata.
struct Calibration {
  double refusal_threshold = 0;   ///< plans that score below it are to be refused, 0..1
  std::optional<double> alpha;    ///< asked for: share of solvable scenes that it may refuse
  std::optional<double> epsilon;  ///< asked for: share of attempts that may fail
  double delta = 0.1;             ///< epsilon holds with probability 1 - delta
  int scenes = 0;                 ///< solvable calibration scenes it was taken from
  std::string command;            ///< that found it
  CalibrationSample sample;       ///< empty in files of version 0.2 and before
};

/// Rewrites the weights file with this calibration: same tensors, atomically, other metadata kept.
/// It takes the place of an earlier one for scenes of its kind, and of one without a sample. The
/// weights' hash changes, since it is over the whole file; what the calibration belongs to is the
/// hash of the tensors, which is stored with it. Throws WeightsError (model/weights_error.h).
void StoreCalibration(const std::string& weights_path, const Calibration& calibration);

/// The calibrations in a file's metadata, one for each kind of scenes, in the order in which they
/// were made. One alone may have an empty sample: training's own threshold. Throws WeightsError
/// that names `path` where one is damaged, or was made for other tensors.
std::vector<Calibration> CalibrationsOf(const WeightsFile& file, const std::string& path);
/// The same of a file on disk.
std::vector<Calibration> CalibrationsOf(const std::string& path);

/// Those of them that have any scenes.
std::vector<CalibrationSample> SamplesOf(const std::vector<Calibration>& calibrations);

/// Hash of names, shapes and values of the networks' tensors as 16-bit floats, which is how they
/// are written: equal for equal networks, whatever the metadata.
std::uint64_t TensorsHash(const WeightsFile& file);

}  // namespace prospect::model

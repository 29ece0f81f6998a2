#include "model/calibration.h"

#include "model/weights.h"

namespace prospect::model {

void StoreCalibration(const std::string& weights_path, const Calibration& calibration) {
  WeightsFile file = ReadWeights(weights_path);
  file.metadata["calibration"] = {{"refusal_threshold", calibration.refusal_threshold},
                                  {"alpha", calibration.alpha},
                                  {"scenes", calibration.scenes},
                                  {"command", calibration.command}};
  WriteWeights(weights_path, file.tensors, file.metadata);
}

}  // namespace prospect::model

#pragma once

#include <string>

#include "base/exit_error.h"

namespace prospect::model {

/// A weights file that is missing, damaged, or of another task or shape. The message names file and
/// reason.
class WeightsError : public ExitError {
 public:
  explicit WeightsError(const std::string& message) : ExitError(kExitWeights, message) {}
};

}  // namespace prospect::model

#pragma once

#include <stdexcept>

namespace prospect::model {

/// A weights file that is missing, damaged, or of another task or shape. The message names file and
/// reason.
class WeightsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace prospect::model

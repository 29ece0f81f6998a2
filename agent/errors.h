#pragma once

#include <string>

#include "base/exit_error.h"

namespace prospect::agent {

/// What was asked for cannot be understood in this task; says what can.
class UsageError : public ExitError {
 public:
  explicit UsageError(const std::string& message) : ExitError(kExitUsage, message) {}
};

/// Nothing can be promised: the weights' calibration does not cover such scenes.
class PromiseError : public ExitError {
 public:
  explicit PromiseError(const std::string& message) : ExitError(kExitWeights, message) {}
};

}  // namespace prospect::agent

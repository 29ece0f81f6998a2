#pragma once

#include <stdexcept>

namespace prospect::agent {

/// What was asked for cannot be understood in this task; says what can.
class UsageError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Nothing can be promised: the weights' calibration does not cover such scenes.
class PromiseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace prospect::agent

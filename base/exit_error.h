#pragma once

#include <stdexcept>
#include <string>

#include "base/exit_codes.h"

namespace prospect {

/// An error that knows the exit status its program should end with. The message says what to do.
/// Errors of a room that have an exit status of their own are derived from it, so that RunMain
/// (base/run_main.h) needs to know none of them.
class ExitError : public std::runtime_error {
 public:
  ExitError(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Work that is worth nothing by halves was stopped; the message says how far it came.
class Interrupted : public ExitError {
 public:
  explicit Interrupted(const std::string& message) : ExitError(kExitInterrupted, message) {}
};

}  // namespace prospect

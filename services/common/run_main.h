#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "services/common/exit_codes.h"

namespace prospect::services {

/// An error that knows the exit status its program should end with. The message says what to do.
class ExitError : public std::runtime_error {
 public:
  ExitError(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Runs a program's body and turns what escapes it into a message on stderr and an exit status:
/// ExitError (BusError is one) gives its own code, base::DiskError 13, any other exception 1. `int
/// main(...) { return RunMain([&] { return Run(argc, argv); }); }`
int RunMain(const std::function<int()>& body);

}  // namespace prospect::services

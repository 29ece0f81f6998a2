#pragma once

#include <string>
#include <vector>

#include "base/child_process.h"

namespace prospect::tests {

/// A program of ours as a child process. Its output goes to a file. Killed when it goes out of
/// scope, so that a failed test leaves nothing behind. One thread.
class Process {
 public:
  /// @param program name in the build's bin folder, such as "prospect-worker"; a path in the build
  /// folder, such as "examples/example-robot"; or an absolute path
  /// @param log file for stdout and stderr
  Process(const std::string& program, const std::vector<std::string>& arguments,
          const std::string& log);

  /// Process id; -1 once it has ended and been waited for.
  int pid() const { return child_.pid(); }
  bool Running() { return child_.Running(); }
  /// Waits for the end. @return exit status, 128 + signal when killed, or -1 when it still runs
  /// after `timeout_ms`
  int Wait(int timeout_ms);
  void Signal(int number) { child_.Signal(number); }
  /// SIGTERM, then waits. @return as Wait
  int Stop(int timeout_ms = 5000);

 private:
  base::ChildProcess child_;
};

}  // namespace prospect::tests

#pragma once

#include <string>
#include <vector>

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
  ~Process();
  Process(Process&& other) noexcept;
  Process& operator=(Process&&) = delete;

  /// Process id; -1 once it has ended and been waited for.
  int pid() const { return pid_; }
  bool Running();
  /// Waits for the end. @return exit status, 128 + signal when killed, or -1 when it still runs
  /// after `timeout_ms`
  int Wait(int timeout_ms);
  void Signal(int number);
  /// SIGTERM, then waits. @return as Wait
  int Stop(int timeout_ms = 5000);

 private:
  bool Reap(int flags);

  int pid_ = -1;
  int status_ = -1;
};

}  // namespace prospect::tests

#pragma once

#include <chrono>
#include <csignal>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/descriptor.h"

namespace prospect::base {

/// What is started, and how.
struct ChildOptions {
  std::vector<std::string> command;                ///< the program's path, and its arguments
  std::map<std::string, std::string> environment;  ///< set besides what this process has
  int out = -1;  ///< descriptor that gets what it prints; -1: where this process prints to
  int err = -1;  ///< the same for its errors
  /// Keeps it away from the terminal: it gets a session of its own, so that Ctrl-C is this
  /// process's alone, and reads nothing.
  bool detached = false;
  /// The signal that it gets when the thread that started it ends, however that happens, so that
  /// nothing is left running.
  int death_signal = SIGKILL;
};

/// A child of this process: killed when this object goes. Its exit status is what a shell would
/// say: its own, 128 + signal where one ended it, 127 where the program could not be started.
/// Movable. Used from one thread at a time.
class ChildProcess {
 public:
  using Milliseconds = std::chrono::milliseconds;

  /// Another program; other threads may run meanwhile. @throws std::runtime_error when there can
  /// be no other process
  explicit ChildProcess(const ChildOptions& options);
  /// This program goes on in a child with `body`, whose return value is the child's exit status;
  /// nothing else of this process is ended there (no destructors, no buffers written). It is killed
  /// when its parent ends. Only while there are no other threads. @throws as above
  explicit ChildProcess(const std::function<int()>& body);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

  /// Process id; -1 once it has ended and that was seen.
  int pid() const { return pid_; }
  bool Running();
  /// Its exit status, at once; nothing while it runs.
  std::optional<int> Status();
  /// Waits for its end. @return its exit status
  int Wait();
  /// The same for at most so long; nothing if it still runs then.
  std::optional<int> Wait(Milliseconds longest);
  /// Sends a signal, if it runs.
  void Signal(int number);
  /// Asks it to end (SIGTERM), and kills it when it does not within `patience`. @return its exit
  /// status; nothing where the kernel does not let it go (a dead network disk)
  std::optional<int> End(Milliseconds patience);
  /// Processor time used so far, seconds; what was last known once it has ended.
  double CpuSeconds();

 private:
  bool Reap(int flags);
  std::optional<int> Kill();

  int pid_ = -1;
  int status_ = -1;
  double cpu_seconds_ = 0;
};

/// What a program said and how it ended.
struct ChildResult {
  std::optional<int> status;  ///< exit status; nothing: it took too long and was ended
  std::string out;            ///< what it printed
  std::string err;            ///< its errors
};

/// Runs a program to its end, or, where that does not come within `longest`, until it is killed,
/// and keeps what it says (`options.out` and `options.err` are not heeded).
/// @throws std::runtime_error when there can be no other process
ChildResult RunCaptured(ChildOptions options, std::chrono::milliseconds longest);

/// Opens a file for a child's output: made, or emptied. Children get it only as `out` or `err`.
/// @throws DiskError
Descriptor OpenOutput(const std::string& path);

/// A program of ours, which lie in one folder. @return its path beside this program
std::string ProgramBeside(const std::string& name);

}  // namespace prospect::base

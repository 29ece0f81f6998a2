#pragma once

#include <string>

#include "base/descriptor.h"
#include "cli/run/invocation.h"

namespace prospect::cli {

/// A program that was started has ended badly and has said why: this process ends alike.
struct Ended {
  int status;
};

/// A program of ours by its path; it need not be there.
std::string PathOf(const std::string& program);

/// How a command's program is started: its path and the table's arguments.
Words StartOf(const Command& command);

/// From now on SIGINT and SIGTERM, however often they come, raise the flag of base/stop_signals.h:
/// what this process has started is ended by it, or, on a terminal, by Ctrl-C itself.
void HeedSignals();

/// Takes this process's place. @return only where that failed: 127, which was told
int Become(const Words& command);

/// Runs a program in the foreground, to its end. Ctrl-C reaches it by the terminal, and SIGTERM
/// only this process, which ends once it has: a second signal while the first is honoured would end
/// it before a robot stood still. @return its exit status, 130 where this process was to stop
int RunToEnd(const Words& command);

/// The same with all that it prints in a file. @throws DiskError
int RunToEnd(const Words& command, const std::string& log);

/// Memory that a child prints into, to be read when it has ended.
class Said {
 public:
  Said();
  int descriptor() const { return file_.get(); }
  std::string text() const;

 private:
  base::Descriptor file_;
};

/// What a file holds; empty: it cannot be read.
std::string TextOf(const std::string& file);

/// The last line that is not empty.
std::string LastLine(const std::string& text);

/// "error: " at the beginning of what a program said is for people who started it themselves.
std::string WithoutError(const std::string& said);

}  // namespace prospect::cli

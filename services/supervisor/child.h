#pragma once

#include <string>
#include <vector>

namespace prospect::services {

/// Starts a program as a child: in a session of its own (Ctrl-C on the terminal is the supervisor's
/// alone), all that it prints going to the descriptor `output`. It gets SIGTERM when this process
/// dies, however that happens, so that nothing is left running. @return its process id
/// @throws std::runtime_error when no process could be made
int StartChild(const std::vector<std::string>& command, int output);

struct EndedChild {
  int pid = -1;    ///< -1: none has ended
  int status = 0;  ///< exit status, 128 + signal when killed
};

/// A child that has ended, without waiting.
EndedChild ReapChild();

}  // namespace prospect::services

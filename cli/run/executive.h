#pragma once

#include <string>

#include "cli/run/invocation.h"

namespace prospect::cli {

/// One episode, by prospect-executive.
struct ExecutiveCall {
  std::string bus;
  std::string out;  ///< folder of results
  int workers = 1;  ///< to wait for
  Words more;       ///< further arguments
};

/// Runs it in the foreground with what was typed. @return its exit status
int RunExecutive(const Invocation& invocation, const ExecutiveCall& call);

/// The folder of results of an episode where --out names none, in the current folder.
std::string UsualFolder(const std::string& task, std::int64_t seed);

}  // namespace prospect::cli

// record: lcm-logger with the exit codes of the other commands.

#include <chrono>
#include <cstdio>
#include <sstream>

#include "base/child_process.h"
#include "base/exit_error.h"
#include "base/stop_signals.h"
#include "cli/run/bus_place.h"
#include "cli/run/carriers.h"
#include "cli/run/processes.h"

namespace prospect::cli {
namespace {

Words LoggerCommand(const RecordOptions& options) {
  Words words{"/usr/bin/env", "lcm-logger", "--lcm-url=" + BusOf(options.bus)};
  if (options.overwrite) words.push_back("-f");
  if (options.append) words.push_back("-a");
  if (options.quiet) words.push_back("-q");
  if (!options.channels.empty()) words.push_back("--channel=" + options.channels);
  words.push_back(options.file);
  return words;
}

// Without what it says of every recording.
std::string Trouble(const std::string& said) {
  std::string trouble;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && !line.starts_with("Logger exiting")) trouble = line;
  return trouble;
}

// Ctrl-C or SIGTERM closes the file; what does not end then is killed.
int RunLogger(const Words& command, const Said& said) {
  HeedSignals();
  base::ChildOptions options;
  options.command = command;
  options.err = said.descriptor();
  options.death_signal = SIGTERM;
  base::ChildProcess logger(options);
  while (!base::StopRequested() && logger.Running()) logger.Wait(std::chrono::milliseconds(200));
  return logger.End(std::chrono::seconds(5)).value_or(128 + SIGKILL);
}

}  // namespace

int Run(const RecordOptions& options) {
  const Said said;
  const int status = RunLogger(LoggerCommand(options), said);
  const std::string words = said.text();
  if (status == 0) {
    if (!options.quiet) std::fputs(words.c_str(), stderr);
    return kExitSuccess;
  }
  std::string trouble = Trouble(words);
  if (trouble.empty()) trouble = "lcm-logger: exit code " + std::to_string(status);
  throw ExitError(kExitDisk, "the recording has ended: " + trouble +
                                 "; make room or give a file that can be written (-f overwrites)");
}

}  // namespace prospect::cli

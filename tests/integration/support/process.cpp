#include "tests/integration/support/process.h"

#include <chrono>

namespace prospect::tests {
namespace {

std::string PathOf(const std::string& program) {
  if (program.front() == '/') return program;
  const bool in_bin = program.find('/') == std::string::npos;
  return std::string(in_bin ? PROSPECT_BIN : PROSPECT_BUILD) + "/" + program;
}

base::ChildProcess Start(const std::string& program, const std::vector<std::string>& arguments,
                         const std::string& log) {
  base::ChildOptions options;
  options.command = {PathOf(program)};
  options.command.insert(options.command.end(), arguments.begin(), arguments.end());
  const base::Descriptor output = base::OpenOutput(log);
  options.out = options.err = output.get();
  return base::ChildProcess(options);
}

}  // namespace

Process::Process(const std::string& program, const std::vector<std::string>& arguments,
                 const std::string& log)
    : child_(Start(program, arguments, log)) {}

int Process::Wait(int timeout_ms) {
  return child_.Wait(std::chrono::milliseconds(timeout_ms)).value_or(-1);
}

int Process::Stop(int timeout_ms) {
  Signal(SIGTERM);
  return Wait(timeout_ms);
}

}  // namespace prospect::tests

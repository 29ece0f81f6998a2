#include "tests/integration/support/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

namespace prospect::tests {
namespace {

std::string PathOf(const std::string& program) {
  if (program.front() == '/') return program;
  const bool in_bin = program.find('/') == std::string::npos;
  return std::string(in_bin ? PROSPECT_BIN : PROSPECT_BUILD) + "/" + program;
}

[[noreturn]] void RunChild(const std::vector<std::string>& words, const std::string& log) {
  // The child must not outlive a test that was killed.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  _exit(127);
}

}  // namespace

Process::Process(const std::string& program, const std::vector<std::string>& arguments,
                 const std::string& log) {
  std::vector<std::string> words{PathOf(program)};
  words.insert(words.end(), arguments.begin(), arguments.end());
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ == 0) RunChild(words, log);
}

Process::Process(Process&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), status_(other.status_) {}

Process::~Process() {
  if (!Running()) return;
  kill(pid_, SIGKILL);
  Reap(0);
}

bool Process::Reap(int flags) {
  int status = 0;
  if (pid_ < 0 || waitpid(pid_, &status, flags) != pid_) return false;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  pid_ = -1;
  return true;
}

bool Process::Running() {
  Reap(WNOHANG);
  return pid_ >= 0;
}

int Process::Wait(int timeout_ms) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(timeout_ms);
  while (Running()) {
    if (std::chrono::steady_clock::now() > deadline) return -1;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return status_;
}

void Process::Signal(int number) {
  if (Running()) kill(pid_, number);
}

int Process::Stop(int timeout_ms) {
  Signal(SIGTERM);
  return Wait(timeout_ms);
}

}  // namespace prospect::tests

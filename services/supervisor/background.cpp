#include "services/supervisor/background.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "base/exit_codes.h"
#include "services/common/clock.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kLongestStartMs = 30000;

// Whether a byte came, or the other end was closed, in time.
bool Await(int end) {
  const std::int64_t deadline_ms = SteadyMs() + kLongestStartMs;
  pollfd awaited{end, POLLIN, 0};
  while (true) {
    const std::int64_t left_ms = deadline_ms - SteadyMs();
    if (left_ms <= 0) return false;
    const int count = poll(&awaited, 1, static_cast<int>(left_ms));
    if (count > 0) return true;
    if (count < 0 && errno != EINTR) return false;
  }
}

}  // namespace

std::optional<int> GoOnInBackground(base::Descriptor* ready) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
  base::Descriptor here(ends[0]), there(ends[1]);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::string("no new process: ") + std::strerror(errno));
  if (child == 0) {
    setsid();
    *ready = std::move(there);
    return std::nullopt;
  }
  there.Close();
  char byte = 0;
  if (!Await(here.get())) {
    kill(child, SIGKILL);
    return kExitTimeout;
  }
  if (read(here.get(), &byte, 1) == 1) return kExitSuccess;
  int status = 0;
  waitpid(child, &status, 0);  // it has closed its end, so it has ended
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void SayReady(base::Descriptor* ready) {
  if (!*ready) return;
  const base::Descriptor nothing(open("/dev/null", O_RDWR | O_CLOEXEC));
  for (const int end : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing.get(), end);
  if (write(ready->get(), "", 1) != 1) return;  // nobody waits any more
  ready->Close();
}

}  // namespace prospect::services

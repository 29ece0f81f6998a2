#include "base/stop_signals.h"

#include <atomic>
#include <csignal>

namespace prospect::base {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

extern "C" void OnStopSignal(int) { stop_requested = true; }

void Install(int signal) {
  struct sigaction action {};
  action.sa_handler = OnStopSignal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the second signal ends the process
  sigaction(signal, &action, nullptr);
}

}  // namespace

void InstallStopSignals() {
  Install(SIGINT);
  Install(SIGTERM);
  std::signal(SIGPIPE, SIG_IGN);
}

bool StopRequested() { return stop_requested; }

void RequestStop() { stop_requested = true; }

}  // namespace prospect::base

#include "cli/run/own_deployment.h"

#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>

#include "base/exit_error.h"
#include "cli/run/bus_place.h"
#include "cli/run/processes.h"

namespace prospect::cli {
namespace {

std::string TakeBus(const std::string& wish) {
  if (wish.empty()) return EnterPrivateBus();
  RequireRoute(wish);
  return wish;
}

void Remove(const std::string& state) {
  std::error_code none;
  std::filesystem::remove_all(state, none);
}

// The folder goes when there can be no bus.
std::string TakeBusOrRemove(const std::string& wish, const std::string& state) try {
  return TakeBus(wish);
} catch (...) {
  Remove(state);
  throw;
}

}  // namespace

OwnDeployment::OwnDeployment(const std::string& bus)
    : state_(MakePrivateState()), services_(TakeBusOrRemove(bus, state_), state_) {
  HeedSignals();  // what was started is stopped before this process ends
  unsetenv("PROSPECT_DEPLOYMENT");
}

OwnDeployment::~OwnDeployment() {
  try {
    services_.Stop(/*silently=*/true);
  } catch (const std::exception&) {
    // They end with this process.
  }
  Remove(state_);
}

void OwnDeployment::Start(Words arguments) {
  arguments.insert(arguments.begin(), {"--lives-with", std::to_string(getpid())});
  services_.Start(arguments);
  if (!services_.Join())
    throw ExitError(kExitServiceLost, "what was just started has ended: see supervisor.log");
}

int OwnDeployment::Explained(int status) const {
  if (status != kExitServiceLost) return status;
  const int given_up = services_.TellGivenUp();
  return given_up == 0 ? status : given_up;
}

}  // namespace prospect::cli

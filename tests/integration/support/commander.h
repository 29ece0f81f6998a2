#pragma once

#include <cstdint>

#include "services/common/clock.h"
#include "services/common/health.h"
#include "tests/integration/support/witness.h"

namespace prospect::tests {

/// A test that plays the executive.
class Commander {
 public:
  explicit Commander(Witness& witness) : witness_(witness), health_(witness.bus, "executive") {}

  action_command_t Start(std::int64_t id, int action) const {
    action_command_t command{};
    command.executive_id = health_.instance_id();
    command.command_id = id;
    command.episode_id = witness_.episode_id;
    command.kind = action_command_t::KIND_START;
    command.action = action;
    return command;
  }

  void Say(action_command_t command) {
    command.utime = services::UtimeNow();
    witness_.bus.Publish(command);
  }

  // Every 20 ms through Witness::Until: keeps the executive's health alive.
  void Beat() { health_.Tick(); }

 private:
  Witness& witness_;
  services::HealthBeacon health_;
};

}  // namespace prospect::tests

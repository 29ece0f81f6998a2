#include "services/executive/action_runner.h"

#include "services/binding/task_messages.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kRepeatMs = 50;
constexpr std::int64_t kNoticeMs = 5000;
// ACTION_STATUS comes at 2 Hz: this long without one means that nobody carries the action out any
// more.
constexpr std::int64_t kSilentMs = 3000;
constexpr std::int64_t kCancelMs = 1000;
// A robot's clock is the wall's; the simulator's runs faster. So the wall limit is the simulated
// one and some slack.
constexpr double kLimitSlackSeconds = 30;

}  // namespace

action_command_t ActionRunner::NextCommand(std::int8_t kind, int action) {
  action_command_t command{};
  command.executive_id = talk_.id();
  command.command_id = talk_.NextCommandId();
  command.episode_id = talk_.view().episode_id();
  command.kind = kind;
  command.action = action;
  return command;
}

std::string ActionRunner::NameOf(const action_command_t& command) const {
  return NamesOf(*talk_.view().task(), {static_cast<std::uint8_t>(command.action)});
}

bool ActionRunner::Named(std::int64_t command_id) const {
  const auto& status = talk_.view().status();
  return status && status->executive_id == talk_.id() && status->command_id == command_id;
}

// Nobody but who stops this executive sends its commands, with an id that it would not reach.
bool ActionRunner::StoppedFromElsewhere(std::int64_t command_id) const {
  const auto& status = talk_.view().status();
  return status && status->executive_id == talk_.id() && status->command_id > command_id;
}

bool ActionRunner::Ended(std::int64_t command_id) const {
  return (Named(command_id) || StoppedFromElsewhere(command_id)) &&
         talk_.view().status()->state != action_status_t::STATE_RUNNING;
}

action_status_t ActionRunner::CarryOut(int action) {
  const action_command_t command = NextCommand(action_command_t::KIND_START, action);
  try {
    Start(command);
    AwaitEnd(command);
  } catch (...) {
    CancelQuietly();
    throw;
  }
  return *talk_.view().status();
}

void ActionRunner::Start(const action_command_t& command) {
  const auto answered = [&] {
    return Named(command.command_id) || StoppedFromElsewhere(command.command_id);
  };
  const bool noticed = talk_.Until(
      answered, kNoticeMs, [&] { talk_.Say(command); }, kRepeatMs);
  if (!noticed) throw ExitError(kExitTimeout, "ACTION_COMMAND was not taken notice of within 5 s");
}

void ActionRunner::AwaitEnd(const action_command_t& command) {
  const auto limit_ms = static_cast<std::int64_t>(
      1000 * (talk_.view().task()->action_time_limit + kLimitSlackSeconds));
  const std::int64_t deadline_ms = SteadyMs() + limit_ms;
  const auto quiet_or_ended = [&] {
    return Ended(command.command_id) || SteadyMs() - talk_.view().status_heard_ms() > kSilentMs;
  };
  if (!talk_.Until(quiet_or_ended, deadline_ms - SteadyMs())) {
    throw ExitError(kExitTimeout, NameOf(command) + " did not end in time; cancelled");
  }
  if (!Ended(command.command_id)) {
    throw ExitError(kExitServiceLost, "ACTION_STATUS fell silent for 3 s while " + NameOf(command) +
                                          " ran: is the simulator alive?");
  }
  if (StoppedFromElsewhere(command.command_id)) {
    throw ExitError(kExitInterrupted, NameOf(command) + " was stopped from a console");
  }
}

// Runs on the way out, perhaps after a stop signal: so it polls the bus itself and throws nothing.
void ActionRunner::CancelQuietly() {
  const action_command_t command = NextCommand(action_command_t::KIND_CANCEL, -1);
  const std::int64_t deadline_ms = SteadyMs() + kCancelMs;
  Periodic due(kRepeatMs);
  while (!Ended(command.command_id) && SteadyMs() < deadline_ms) {
    if (due.Due(SteadyMs())) talk_.Say(command);
    talk_.bus().Poll(static_cast<int>(due.Remaining(SteadyMs())));
  }
}

}  // namespace prospect::services

#pragma once

#include <cstdint>
#include <string>

#include "lcmtypes/messages.h"
#include "services/executive/conversation.h"

namespace prospect::services {

/// Carries actions out through ACTION_COMMAND and ACTION_STATUS: a command is repeated until the
/// status names it, and a stop signal, or an action that outlasts its limit, sends CANCEL before
/// anything else happens. One thread; the conversation must outlive it.
class ActionRunner {
 public:
  explicit ActionRunner(Conversation& talk) : talk_(talk) {}

  /// Starts `action` and waits for its end. Returns the final status: succeeded, failed, cancelled,
  /// refused, or ended, where the robot cannot tell. Throws kExitServiceLost when whoever carries
  /// actions out falls silent, kExitTimeout when it takes no notice of the command or the action
  /// never ends, and kExitInterrupted after a stop signal, or when a console stopped it; whatever
  /// is thrown, the action is cancelled first.
  action_status_t CarryOut(int action);

 private:
  action_command_t NextCommand(std::int8_t kind, int action);
  std::string NameOf(const action_command_t& command) const;
  bool Named(std::int64_t command_id) const;
  bool StoppedFromElsewhere(std::int64_t command_id) const;
  bool Ended(std::int64_t command_id) const;
  void Start(const action_command_t& command);
  void AwaitEnd(const action_command_t& command);
  void CancelQuietly();

  Conversation& talk_;
};

}  // namespace prospect::services

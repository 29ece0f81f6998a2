#pragma once

#include <optional>
#include <vector>

#include "agent/world.h"
#include "services/executive/action_runner.h"
#include "services/executive/conversation.h"
#include "services/executive/options.h"

namespace prospect::services {

/// The simulator or robot on the bus, as an episode's world. What ends an episode from outside is
/// an ExitError. One thread; conversation and options must outlive it.
class BusWorld : public agent::World {
 public:
  /// @throws ExitError, kExitUsage: a person is to be asked, and none can answer
  BusWorld(Conversation& talk, const ExecutiveOptions& options);

  /// Waits for all services that the episode needs, model servers and workers included, and claims
  /// the robot where it is to move.
  void Await() override;
  const agent::TaskView& task() const override { return task_; }
  agent::Glimpse Begin() override;
  std::int64_t seed() const override;
  std::optional<agent::SceneLabel> label() const override;
  agent::ActionResult CarryOut(int action) override;
  agent::Glimpse Look() override;
  std::vector<agent::Picture> Frames() const override;

 private:
  void AskPerson(action_status_t* status);

  Conversation& talk_;
  const ExecutiveOptions& options_;
  ActionRunner actions_;
  agent::TaskView task_;
  std::int64_t frame_ = 0;  // of the first picture after the latest action
};

}  // namespace prospect::services

#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "agent/world.h"
#include "sim/task.h"

namespace prospect::tools {

/// A task's table as the agent sees it.
agent::TaskView TaskViewOf(const sim::TaskSpec& spec);

// What may be asked for of a built-in task, in the scene that is set up; none where no file of its
// name is installed.
std::vector<planner::GoalFact> GoalsOf(const sim::TaskSpec& spec);

/// What is there in the scene that `task` shows.
agent::SceneLabel SceneLabelOf(const sim::Task& task, std::uint64_t scene_seed);

/// A simulated task in this process as an episode's world. Pictures carry sensor noise, frame
/// numbers count ticks, as on the bus and in data sets. Not thread safe; the task must outlive it.
class SimulatedWorld : public agent::World {
 public:
  /// Looks at the world after each action of an episode that goes on, and leaves it as it was.
  using AfterAction = std::function<void(sim::Task& task)>;

  /// @param image_noise standard deviation of the sensor noise, share of full scale
  SimulatedWorld(sim::Task& task, std::uint64_t scene_seed, double image_noise,
                 AfterAction after = nullptr);

  void Await() override {}
  const agent::TaskView& task() const override { return view_; }
  agent::Glimpse Begin() override;
  std::int64_t seed() const override { return static_cast<std::int64_t>(seed_); }
  std::optional<agent::SceneLabel> label() const override { return SceneLabelOf(task_, seed_); }
  agent::ActionResult CarryOut(int action) override;
  agent::Glimpse Look() override;

 private:
  sim::Task& task_;
  std::uint64_t seed_;
  double image_noise_;
  AfterAction after_;
  agent::TaskView view_;
};

}  // namespace prospect::tools

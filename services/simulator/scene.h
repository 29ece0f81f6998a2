#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "lcmtypes/messages.h"
#include "sim/task.h"
#include "sim/task_factory.h"

namespace prospect::services {

/// One episode of a simulated task as the bus sees it: frames are counted from the first picture
/// after a reset, one a tick, and the latest picture and its label are kept, so that a repeat is
/// the same picture. The frames of an episode equal those that sim::RunPlan makes for the same seed
/// and plan, with the sensor noise of base/sensor_noise.h added.
///
/// One thread; owns the task. utime of the kept messages is 0: whoever publishes them stamps them.
class Scene {
 public:
  /// Makes the task and resets it to `seed`. Throws std::invalid_argument for an unknown task or
  /// options out of range.
  Scene(std::string task_name, const sim::TaskOptions& options, std::int64_t episode_id,
        std::uint64_t seed);

  /// A new episode, with a name of its own. `objects` and `legs` of 0 keep the present setting.
  /// Throws std::invalid_argument, with the old scene untouched, when they are out of range or when
  /// the present episode has this name.
  void Reset(std::int64_t episode_id, std::uint64_t seed, int objects, int legs);

  /// Begins an action. Returns why not, or an empty text when it has begun.
  std::string Start(int action);

  /// Gives the running action up and lets the robot brake: braking() is true for as many ticks as
  /// that may take.
  void Cancel();

  /// One tick of simulated time, and the picture and label after it.
  void Tick();

  /// Whether the clock must go on: an action runs, or the robot still brakes.
  bool moving() const { return running() || braking_ticks_ > 0; }
  bool running() const;

  std::int64_t episode_id() const { return episode_id_; }
  std::int64_t frame() const { return observation_.frame; }
  const observation_t& observation() const { return observation_; }
  const label_t& label() const { return label_; }
  const task_t& task() const { return task_message_; }
  sim::Progress progress() const { return task_->progress(); }

 private:
  void MakeTask();
  void Capture(std::int64_t frame, bool segment_end);

  std::string task_name_;
  sim::TaskOptions options_;
  std::unique_ptr<sim::Task> task_;
  std::int64_t episode_id_ = 0;
  std::uint64_t seed_ = 0;
  int braking_ticks_ = 0;
  observation_t observation_{};
  label_t label_{};
  task_t task_message_{};
};

/// TASK for a task's specification; utime 0, task_hash filled in.
task_t MakeTaskMessage(const sim::TaskSpec& spec);

/// OUTCOME_ value of label_t.
std::int8_t OutcomeCode(sim::Outcome outcome);

}  // namespace prospect::services

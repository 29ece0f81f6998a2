#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "lcmtypes/messages.h"
#include "model/trial.h"

namespace prospect::services {

/// A recorded run that is no whole trial. The message is the reason, such as "frame 17 is missing".
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a log holds of one run of one scene: pictures and labels by frame, each kept once however
/// often it was published, and what was said of actions. Plain data with one thing to do: become a
/// trial. Not thread-safe.
class RecordedRun {
 public:
  explicit RecordedRun(std::int64_t episode_id) : episode_id_(episode_id) {}

  std::int64_t episode_id() const { return episode_id_; }
  /// Highest frame heard of, in pictures or labels; -1 for none.
  std::int64_t last_frame() const { return last_frame_; }
  /// Number of different pictures.
  std::size_t pictures() const { return pictures_.size(); }

  void Add(const observation_t& observation);
  void Add(const label_t& label);
  void Add(const action_status_t& status) { statuses_.push_back(status); }
  void Add(const verdict_t& verdict) { verdicts_.push_back(verdict); }
  /// The TASK in force; the latest one given counts.
  void SetTask(std::shared_ptr<const task_t> task) { task_ = std::move(task); }

  /// The trial, as a collector would have written it for this scene, but for two things: its
  /// pictures are those that were on the bus, with the sensor's noise in them, and image_noise is
  /// therefore 0, so that no reader adds it again. Frames after the one that ended the trial are
  /// left out. Where nobody said LABEL, ACTION_STATUS and
  /// VERDICT tell the same (LabelsFrom). A robot's trial
  /// is numbered by its episode's id, or, where that has more than nine digits, by a hash of it.
  /// @throws RunError when a frame or its label is missing, the trial did not end, or messages
  /// contradict each other
  model::Trial ToTrial();

 private:
  std::int64_t FindEnd() const;
  void RequireWhole(std::int64_t end) const;
  void Describe(std::int64_t end, model::Trial& trial) const;
  void AppendFrame(std::int64_t frame, model::Trial& trial) const;

  std::int64_t episode_id_;
  std::int64_t last_frame_ = -1;
  std::map<std::int64_t, observation_t> pictures_;
  std::map<std::int64_t, label_t> labels_;
  std::vector<action_status_t> statuses_;  // as they came
  std::vector<verdict_t> verdicts_;
  std::shared_ptr<const task_t> task_;
};

/// The hash of a task as data sets store it (sim::TaskSpec::Hash as text), from what TASK says.
/// TASK's own task_hash also covers the plan's length, which data sets leave open.
std::string DataSetTaskHash(const task_t& task);

}  // namespace prospect::services

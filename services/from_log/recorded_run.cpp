#include "services/from_log/recorded_run.h"

#include <algorithm>

#include "base/hash.h"
#include "services/binding/spec_messages.h"
#include "services/from_log/status_labels.h"

namespace prospect::services {
namespace {

std::string FrameText(const std::string& what, std::int64_t frame) {
  return what + " " + std::to_string(frame) + " is missing";
}

// What the trial earns on a frame, as collectors pay it.
float RewardOf(std::int8_t outcome) {
  if (outcome == label_t::OUTCOME_SUCCESS) return 1.0f;
  return outcome == label_t::OUTCOME_FAILURE ? -1.0f : 0.0f;
}

bool IsOver(const label_t& label) {
  return label.outcome == label_t::OUTCOME_SUCCESS || label.outcome == label_t::OUTCOME_FAILURE;
}

// Of a robot's trial.
std::uint64_t RecordedNumber(std::int64_t episode_id) {
  const auto id = static_cast<std::uint64_t>(episode_id);
  return id <= model::kLastRecordedNumber ? id : base::Mix64(id) % (model::kLastRecordedNumber + 1);
}

}  // namespace

std::string DataSetTaskHash(const task_t& task) { return base::HexText(SpecFromTask(task).Hash()); }

void RecordedRun::Add(const observation_t& observation) {
  pictures_.emplace(observation.frame, observation);
  last_frame_ = std::max(last_frame_, observation.frame);
}

void RecordedRun::Add(const label_t& label) {
  labels_.emplace(label.frame, label);
  last_frame_ = std::max(last_frame_, label.frame);
}

// The frame on which the trial ended.
std::int64_t RecordedRun::FindEnd() const {
  for (const auto& [frame, label] : labels_) {
    if (IsOver(label)) return frame;
  }
  throw RunError(task_ ? "the trial did not end" : "there is no TASK message");
}

void RecordedRun::RequireWhole(std::int64_t end) const {
  if (!task_) throw RunError("there is no TASK message");
  for (std::int64_t frame = 0; frame <= end; ++frame) {
    const auto picture = pictures_.find(frame);
    const auto label = labels_.find(frame);
    if (picture == pictures_.end()) throw RunError(FrameText("frame", frame));
    if (label == labels_.end()) throw RunError(FrameText("the label of frame", frame));
    if (picture->second.width != task_->image_width ||
        picture->second.height != task_->image_height) {
      throw RunError("frame " + std::to_string(frame) + " has another size than TASK says");
    }
    if (label->second.num_present != task_->num_actions) {
      throw RunError("label and TASK disagree on the number of actions");
    }
  }
}

void RecordedRun::Describe(std::int64_t end, model::Trial& trial) const {
  const label_t& last = labels_.at(end);
  trial.simulated = last.seed >= 0;
  trial.seed =
      trial.simulated ? static_cast<std::uint64_t>(last.seed) : RecordedNumber(episode_id_);
  trial.task = task_->name;
  trial.outcome = last.outcome == label_t::OUTCOME_SUCCESS ? "success" : "failure";
  trial.reason = last.reason;
  trial.width = task_->image_width;
  trial.height = task_->image_height;
  trial.tick_seconds = task_->tick_seconds;
  trial.image_noise = 0;
  trial.light = last.light;
  trial.present.assign(last.present.begin(), last.present.end());
  trial.num_actions = task_->num_actions;
  trial.successors = SpecFromTask(*task_).successors;
  trial.plan_length = task_->plan_length;
  trial.world_version = task_->world_version;
  trial.task_hash = DataSetTaskHash(*task_);
}

void RecordedRun::AppendFrame(std::int64_t frame, model::Trial& trial) const {
  const std::vector<std::uint8_t>& pixels = pictures_.at(frame).data;
  const label_t& label = labels_.at(frame);
  trial.images.insert(trial.images.end(), pixels.begin(), pixels.end());
  trial.actions.push_back(label.action);
  trial.prev_action.push_back(label.previous_action);
  trial.segment.push_back(label.segment);
  trial.rewards.push_back(RewardOf(label.outcome));
  trial.dones.push_back(IsOver(label) ? 1 : 0);
  // Segments are numbered without gaps (model::ValidateTrial), so a label can add no more than one.
  if (label.segment < 0 || label.segment > trial.segments()) return;
  if (label.segment == trial.segments()) trial.segment_succeeded.push_back(0);
  if (label.segment_end && label.outcome != label_t::OUTCOME_FAILURE)
    trial.segment_succeeded.back() = 1;
}

model::Trial RecordedRun::ToTrial() {
  if (labels_.empty() && task_) labels_ = LabelsFrom(statuses_, verdicts_, *task_, last_frame_);
  const std::int64_t end = FindEnd();
  RequireWhole(end);
  model::Trial trial;
  Describe(end, trial);
  for (std::int64_t frame = 0; frame <= end; ++frame) AppendFrame(frame, trial);
  return trial;
}

}  // namespace prospect::services

#include "services/executive/bus_view.h"

#include <algorithm>

#include "lcmtypes/validate.h"
#include "model/refusal/scene_kind.h"
#include "services/binding/calibration_messages.h"
#include "services/binding/task_messages.h"
#include "services/common/clock.h"

namespace prospect::services {
namespace {

// Frames kept for the video: 10 minutes at 10 Hz, 74 MB at 64x64. An episode of ours lasts one.
constexpr std::size_t kMostFrames = 6000;

constexpr char kMisfit[] = "not the size that TASK says";

std::string SizeText(std::int32_t width, std::int32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

agent::Picture PictureOf(const observation_t& observation) {
  return {observation.width, observation.height, observation.data};
}

BusView::BusView(Bus& bus) : bus_(bus) {
  subscriptions_.push_back(bus.Subscribe<task_t>([this](const task_t& task) {
    world_heard_ms_ = SteadyMs();
    task_ = task;
    task_hash_ = TaskHash(task);
  }));
  subscriptions_.push_back(bus.Subscribe<model_info_t>(
      [this](const model_info_t& info) { servers_.Hear(info, SteadyMs()); }));
  subscriptions_.push_back(bus.Subscribe<calibration_t>(
      [this](const calibration_t& calibration) { OnCalibration(calibration); }));
  subscriptions_.push_back(bus.Subscribe<observation_t>(
      [this](const observation_t& observation) { OnObservation(observation); }));
  subscriptions_.push_back(
      bus.Subscribe<action_status_t>([this](const action_status_t& status) { OnStatus(status); }));
  subscriptions_.push_back(
      bus.Subscribe<label_t>([this](const label_t& label) { OnLabel(label); }));
}

const std::vector<model::CalibrationSample>& BusView::calibrations(
    std::int64_t weights_hash) const {
  static const std::vector<model::CalibrationSample> none;
  const auto found = calibrations_.find(weights_hash);
  return found == calibrations_.end() ? none : found->second;
}

void BusView::OnCalibration(const calibration_t& calibration) {
  const model::CalibrationSample sample = SampleFrom(calibration);
  auto& known = calibrations_[calibration.weights_hash];
  const auto same = std::find_if(known.begin(), known.end(), [&](const auto& other) {
    return model::KindOf(other) == model::KindOf(sample);
  });
  if (same != known.end()) {
    *same = sample;
  } else if (known.size() < messages::kMaxCalibrations) {
    known.push_back(sample);
  }
}

void BusView::FollowSeed(std::int64_t seed) {
  Follow(-1);
  seed_ = seed;
}

void BusView::Follow(std::int64_t episode_id) {
  episode_id_ = episode_id;
  seed_ = -1;
  latest_.reset();
  status_.reset();
  label_.reset();
  frames_.clear();
}

std::string BusView::PictureDefects() const {
  const auto found = bus_.counters().find(ChannelOf<observation_t>());
  if (found == bus_.counters().end()) return "";
  std::string defects = misfit_;
  for (const auto& [reason, count] : found->second.refused) {
    if (reason != kMisfit) defects += (defects.empty() ? "" : "; ") + reason;
  }
  return defects;
}

void BusView::OnStatus(const action_status_t& status) {
  world_heard_ms_ = SteadyMs();
  holder_id_ = status.holder_id;
  present_episode_id_ = status.episode_id;
  if (status.episode_id != episode_id_) return;
  status_ = status;
  status_heard_ms_ = SteadyMs();
}

// The simulator says a label before its picture, so none of the episode's pictures is missed.
void BusView::OnLabel(const label_t& label) {
  world_heard_ms_ = SteadyMs();
  labels_heard_ = true;
  if (seed_ >= 0 && label.seed == seed_ && label.episode_id != episode_id_) {
    const std::int64_t seed = seed_;
    Follow(label.episode_id);
    seed_ = seed;
  }
  if (label.episode_id == episode_id_) label_ = label;
}

void BusView::OnObservation(const observation_t& observation) {
  world_heard_ms_ = SteadyMs();
  pictures_heard_ = std::min(pictures_heard_ + 1, 2);
  if (!task_) return;
  if (observation.width != task_->image_width || observation.height != task_->image_height) {
    misfit_ = SizeText(observation.width, observation.height) + " pixels, where TASK says " +
              SizeText(task_->image_width, task_->image_height);
    return bus_.CountRefused(ChannelOf<observation_t>(), kMisfit);
  }
  if (episode_id_ < 0 && seed_ < 0) Follow(observation.episode_id);
  if (observation.episode_id != episode_id_) return;
  if (frames_.size() < kMostFrames) frames_[observation.frame] = PictureOf(observation);
  if (!latest_ || observation.frame >= latest_->frame) latest_ = observation;
}

}  // namespace prospect::services

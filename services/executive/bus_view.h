#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "agent/picture.h"
#include "model/refusal/sample.h"
#include "services/binding/server_list.h"
#include "services/common/bus.h"

namespace prospect::services {

/// What the bus has said about the world: latest TASK, pictures and status of the episode that is
/// followed, and the model servers. Belongs to the bus's thread; the bus must outlive it.
class BusView {
 public:
  explicit BusView(Bus& bus);

  /// From now on pictures and status of this episode count; those of another are forgotten and left
  /// alone.
  void Follow(std::int64_t episode_id);
  /// Takes whatever episode the next picture belongs to.
  void FollowAny() { Follow(-1); }
  /// Takes the episode of the latest LABEL that says this seed, and none before one does.
  void FollowSeed(std::int64_t seed);

  const std::optional<task_t>& task() const { return task_; }
  /// TaskHash of the latest TASK, whatever that message says its hash is; 0 before the first.
  std::int64_t task_hash() const { return task_hash_; }
  std::int64_t episode_id() const { return episode_id_; }
  /// Latest picture of the episode, by frame number; nothing before the first. A picture counts
  /// once TASK is known and says its size; one of another size is refused and counted.
  const std::optional<observation_t>& latest() const { return latest_; }
  const std::optional<action_status_t>& status() const { return status_; }
  /// Who holds the robot, by the latest ACTION_STATUS of any episode: 0 where nobody does; nothing
  /// before the first.
  const std::optional<std::int64_t>& holder_id() const { return holder_id_; }
  /// The episode that stands, by the latest ACTION_STATUS, whichever is followed; nothing before
  /// the first.
  const std::optional<std::int64_t>& present_episode_id() const { return present_episode_id_; }
  /// When `status` was heard, on SteadyMs()'s clock.
  std::int64_t status_heard_ms() const { return status_heard_ms_; }
  /// When anything that a simulator or robot says (HEALTH apart) was last heard, on SteadyMs()'s
  /// clock; 0: never.
  std::int64_t world_heard_ms() const { return world_heard_ms_; }
  const std::optional<label_t>& label() const { return label_; }
  /// Whether each picture comes with a LABEL, as a simulator's does; true, too, before enough was
  /// heard to tell.
  bool LabelsExpected() const { return labels_heard_ || pictures_heard_ < 2; }
  const ServerList& servers() const { return servers_; }
  /// The calibrations of these weights that were heard, one for each kind of scenes.
  const std::vector<model::CalibrationSample>& calibrations(std::int64_t weights_hash) const;
  /// Every picture of the episode heard so far, by frame number.
  const std::map<std::int64_t, agent::Picture>& frames() const { return frames_; }
  /// What is wrong with pictures that came and were refused ("32x32 pixels, where TASK says
  /// 64x64"); empty when there were none.
  std::string PictureDefects() const;

 private:
  void OnObservation(const observation_t& observation);
  void OnCalibration(const calibration_t& calibration);
  void OnStatus(const action_status_t& status);
  void OnLabel(const label_t& label);

  Bus& bus_;

  ServerList servers_;
  // By weights hash.
  std::map<std::int64_t, std::vector<model::CalibrationSample>> calibrations_;
  std::optional<task_t> task_;
  std::int64_t task_hash_ = 0;
  std::int64_t episode_id_ = -1;
  std::int64_t seed_ = -1;  // of the episode to follow; -1: it is known by its id, or any will do
  std::optional<std::int64_t> holder_id_;
  std::optional<std::int64_t> present_episode_id_;
  std::optional<observation_t> latest_;
  std::optional<action_status_t> status_;
  std::int64_t status_heard_ms_ = 0;
  std::int64_t world_heard_ms_ = 0;
  std::string misfit_;  // size of the latest picture that did not fit TASK
  std::optional<label_t> label_;
  bool labels_heard_ = false;  // of any episode
  int pictures_heard_ = 0;     // of any episode; counted as far as LabelsExpected() asks
  std::map<std::int64_t, agent::Picture> frames_;
  std::vector<Subscription> subscriptions_;
};

/// The picture in an observation.
agent::Picture PictureOf(const observation_t& observation);

}  // namespace prospect::services

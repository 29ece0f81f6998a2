#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lcmtypes/messages.h"
#include "planner/path.h"
#include "services/console/picture_store.h"

namespace prospect::services::console {

/// An action that was carried out, or is.
struct Act {
  std::int64_t command_id = 0;
  int action = -1;
  std::int8_t state = action_status_t::STATE_RUNNING;
  std::string reason;
  std::int64_t search_id = 0;  ///< the search before it; 0: none was made
  planner::Path path;          ///< from that search's root, this action the last
  PicturePtr seen;             ///< what the camera saw when it had ended; null until then
  double surprise = -1;        ///< of what was seen, as model/surprise.h has it; -1: not known
};

/// One episode as a page shows it: what is said of it on OBSERVATION, ACTION_STATUS, VERDICT, PLAN
/// and the executive's HEALTH. One thread at a time.
class EpisodeView {
 public:
  /// A picture with a frame number that is new. A new episode id begins everything anew.
  void Hear(const observation_t& observation);
  void Hear(const action_status_t& status);
  /// How an action that has ended went, where its robot cannot tell.
  void Hear(const verdict_t& verdict);
  void Hear(const plan_t& plan);
  void Hear(const search_root_t& root, std::int64_t now_us);
  /// An executive's: the outcome is its last word.
  void Hear(const health_t& health);
  /// An imagined picture has come: acts whose own it is get their surprise.
  void TakePicture(const std::string& key, const Picture& picture);

  /// Grows with whatever ToJson() tells.
  std::uint64_t revision() const { return revision_; }
  std::int64_t id() const { return id_; }
  const std::vector<Act>& acts() const { return acts_; }
  const std::optional<action_status_t>& status() const { return status_; }
  bool running() const;
  const std::string& outcome() const { return outcome_; }
  const std::optional<plan_t>& plan() const { return plan_; }

  /// The camera's latest picture; null before the first.
  const PicturePtr& camera() const { return camera_; }
  std::int64_t frame() const { return frame_; }
  /// How many pictures with new frame numbers were heard since the beginning of the program.
  std::uint64_t pictures() const { return pictures_; }
  std::int64_t picture_utime() const { return picture_utime_; }

  nlohmann::json ToJson() const;

 private:
  void Begin(std::int64_t episode_id);
  void Finish(Act* act, const action_status_t& status);
  void SeeEnd();

  std::uint64_t revision_ = 1, pictures_ = 0;
  std::int64_t id_ = -1, frame_ = -1, picture_utime_ = 0;
  PicturePtr camera_;
  std::optional<action_status_t> status_;
  std::optional<plan_t> plan_, first_plan_;
  std::vector<Act> acts_;
  std::vector<std::int64_t> searches_;  // in order
  std::int64_t executive_ = 0;
  std::size_t acts_before_search_ = 0;
  std::int64_t end_frame_ = -1;  // of the last act: its picture may come after the status
  std::string outcome_;
  bool refused_ = false;
};

}  // namespace prospect::services::console

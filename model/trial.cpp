#include "model/trial.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/hash.h"
#include "model/dataset.h"

namespace prospect::model {
namespace {

constexpr std::uint64_t kSplitSalt =
    0x70726f7370656374ULL;  // fixed for ever: it decides the test set

void Require(bool holds, const Trial& trial, const std::string& rule) {
  if (!holds) throw DataError("trial of seed " + std::to_string(trial.seed) + ": " + rule);
}

void RequireSizes(const Trial& t, bool with_images) {
  const std::size_t n = t.actions.size();
  Require(n > 0, t, "has no frames");
  Require(t.width > 0 && t.height > 0, t, "width and height must be positive");
  Require(t.prev_action.size() == n && t.segment.size() == n && t.rewards.size() == n &&
              t.dones.size() == n,
          t, "actions, prev_action, segment, rewards and dones must be of one length");
  Require(t.num_actions > 0 && t.present.size() == static_cast<std::size_t>(t.num_actions), t,
          "present must have one entry an action");
  Require(t.num_landmarks >= 0 &&
              t.landmarks.size() == n * static_cast<std::size_t>(t.num_landmarks) * 2,
          t, "landmarks must hold frames x num_landmarks x 2 numbers");
  Require(!with_images || t.images.size() == n * t.frame_bytes(), t,
          "images must hold frames x height x width x 3 bytes");
}

void RequireNumbers(const Trial& t) {
  Require(std::isfinite(t.tick_seconds) && t.tick_seconds > 0, t, "tick_seconds must be positive");
  Require(t.image_noise >= 0 && t.image_noise <= 1, t, "image_noise must be 0 to 1");
  Require(std::isfinite(t.light), t, "light is not a number");
  Require(std::all_of(t.rewards.begin(), t.rewards.end(), [](float r) { return std::isfinite(r); }),
          t, "a reward is not a number");
  for (std::size_t i = 0; i + 1 < t.landmarks.size(); i += 2) {
    const float u = t.landmarks[i], v = t.landmarks[i + 1];
    Require((std::isfinite(u) && std::isfinite(v)) || (std::isnan(u) && std::isnan(v)), t,
            "a landmark's two coordinates must be numbers, or both NaN where there is none");
  }
}

void RequireSuccessors(const Trial& t) {
  if (t.successors.empty()) return;
  Require(t.successors.size() == static_cast<std::size_t>(t.num_actions) + 1, t,
          "successors must have one row an action and one for the start");
  for (const std::vector<int>& row : t.successors) {
    for (const int next : row) {
      Require(next >= 0 && next < t.num_actions, t, "successors: action out of range");
    }
  }
}

void RequireFrame(const Trial& t, int i) {
  const int previous = i == 0 ? -1 : t.segment[i - 1];
  const int segment = t.segment[i];
  Require(segment == previous || segment == previous + 1, t, "segments must be numbered in order");
  Require((segment < 0) == (t.actions[i] == t.null_action()), t,
          "the null action belongs to the frames before the first segment and only to them");
  Require(t.actions[i] >= 0 && t.actions[i] <= t.num_actions, t, "action out of range");
  Require(t.prev_action[i] >= 0 && t.prev_action[i] <= t.num_actions, t,
          "prev_action out of range");
  Require(segment != previous || i == 0 || t.actions[i] == t.actions[i - 1], t,
          "the action changed inside a segment");
}

}  // namespace

Split SplitOf(std::uint64_t seed) {
  switch (base::Mix64(seed ^ kSplitSalt) % 10) {
    case 0:
      return Split::kTest;
    case 1:
      return Split::kValid;
    default:
      return Split::kTrain;
  }
}

const char* SplitName(Split split) {
  switch (split) {
    case Split::kTrain:
      return "train";
    case Split::kValid:
      return "valid";
    case Split::kTest:
      return "test";
  }
  return "unknown";
}

void ValidateTrial(const Trial& trial, bool with_images) {
  Require(trial.seed <= kLastRecordedNumber, trial, "numbers of trials are 0 to 999,999,999");
  Require(!trial.simulated || trial.seed <= kLastCollectionSeed, trial,
          "data sets take seeds 0 to 999,999; later ones are kept for tuning and evaluation");
  Require(trial.outcome == "success" || trial.outcome == "failure", trial,
          "outcome must be success or failure");
  Require(!trial.task.empty(), trial, "task is empty");
  RequireSizes(trial, with_images);
  RequireNumbers(trial);
  RequireSuccessors(trial);
  for (int i = 0; i < trial.frames(); ++i) RequireFrame(trial, i);
  Require(trial.segments() == trial.segment.back() + 1, trial,
          "segment_succeeded must have one entry a segment");
}

}  // namespace prospect::model

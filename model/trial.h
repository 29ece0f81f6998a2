#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace prospect::model {

/// Seeds of collected trials (docs/training.md): everything above is kept for tuning, calibration
/// and reported figures, so a trial whose seed lies outside may not enter a data set.
inline constexpr std::uint64_t kFirstCollectionSeed = 0;
inline constexpr std::uint64_t kLastCollectionSeed = 999'999;

/// Numbers of trials that were recorded on a robot: no scene of a simulator is behind them.
inline constexpr std::uint64_t kLastRecordedNumber = 999'999'999;

/// The part of a data set that a trial belongs to. For trials that are made it is a fixed function
/// of the seed, so a trial never moves from one part to another when a data set grows or is packed
/// anew; data sets of people's videos hold out trials or a person by their masks instead.
enum class Split { kTrain, kValid, kTest };

/// A tenth of the seeds is test, a tenth validation, the rest training (by a hash of the seed).
Split SplitOf(std::uint64_t seed);

/// "train", "valid" or "test".
const char* SplitName(Split split);

/// One recorded trial of a task: what was seen at 10 Hz (or the task's own tick) and what was being
/// done.
///
/// A plain value without threads or ownership rules. `frames()` = N is the number of images; every
/// per-frame vector has N entries. Segments are the stretches during which one action ran; they are
/// numbered from 0. Frames before the first action carry the null action (== num_actions) and
/// segment -1. The frame on which segment k+1 begins is the frame that met the end condition of
/// segment k; the last frame of the trial ends the last segment. Images are clean: sensor noise is
/// a function of (seed, frame) and is added by whoever reads them (base/sensor_noise.h), because
/// clean images compress ten times better.
struct Trial {
  /// Of what was simulated, the scene and its noise: kFirstCollectionSeed..kLastCollectionSeed.
  /// Else any number that tells the trial from others, 0..kLastRecordedNumber.
  std::uint64_t seed = 0;
  bool simulated = true;
  std::string name;  ///< where trials have names of their own, such as "Suturing_B001"
  /// The part of the data set that its masks put the trial in; nothing: SplitOf(seed).
  std::optional<Split> split;
  std::string task;     ///< "navigation", ...
  std::string outcome;  ///< "success" or "failure"
  std::string reason;   ///< why it failed, e.g. "time" or "collision(barrel)"; empty on success
  int width = 0;        ///< pixels
  int height = 0;       ///< pixels
  double tick_seconds = 0.1;  ///< simulated seconds between frames
  double image_noise = 0.0;   ///< sigma of the sensor noise to add, as a share of full range (255)
  double light = 1.0;         ///< factor on the light, drawn once a trial; already in the images

  std::vector<std::uint8_t> images;  ///< N x height x width x 3, RGB, row major, clean
  std::vector<int> actions;          ///< label of each frame, 0..num_actions; num_actions = null
  std::vector<int> prev_action;      ///< action of the segment before this one, null in the first
  std::vector<int> segment;          ///< number of the segment, -1 before the first
  std::vector<float> rewards;        ///< per frame; the outcome is paid on the last one
  std::vector<std::uint8_t> dones;   ///< 1 on the trial's last frame, else 0

  int num_landmarks = 0;  ///< K points followed in the picture, may be 0 (logs of a real robot)
  std::vector<float> landmarks;  ///< N x K x 2: u from the left, v from the top, in picture sizes;
                                 ///< NaN where the scene has no such point (sim::Task::Landmarks)

  std::vector<int>
      present;          ///< per action 0 or 1: may the scene offer it (its object stands on site)
  int num_actions = 0;  ///< size of the task's action table
  /// [num_actions + 1]: which actions the task's graph lets follow each action, ascending; the last
  /// row is for the start. Empty: not known (data sets made before it was stored), then everything
  /// but the action just done.
  std::vector<std::vector<int>> successors;
  int plan_length = 0;  ///< actions in a complete plan of this trial
  std::string world_version;
  std::string task_hash;  ///< hash of the task's action table, as text
  std::vector<std::int8_t>
      segment_succeeded;  ///< per segment 1 if it met its end condition, else 0

  Split part() const { return split.value_or(SplitOf(seed)); }
  int frames() const { return static_cast<int>(actions.size()); }
  int segments() const { return static_cast<int>(segment_succeeded.size()); }
  int null_action() const { return num_actions; }
  bool succeeded() const { return outcome == "success"; }
  std::size_t frame_bytes() const { return static_cast<std::size_t>(width) * height * 3; }
  /// The clean image of frame `i` (0..frames()-1), height x width x 3 bytes inside `images`.
  const std::uint8_t* frame(int i) const { return images.data() + i * frame_bytes(); }
};

/// Checks every rule above (sizes, ranges, order of segments); `with_images` false skips the image
/// bytes. Throws DataError (model/dataset.h) naming the seed and the rule that is broken.
void ValidateTrial(const Trial& trial, bool with_images = true);

}  // namespace prospect::model

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "lcmtypes/messages.h"
#include "model/jigsaws/gestures.h"
#include "model/segments/transcription.h"

namespace prospect::report {
class VideoReader;
}

namespace prospect::services {

/// Which video is played, and how.
struct VideoChoice {
  std::string task = model::jigsaws::TaskOfFolder(
      model::jigsaws::TaskFolders()
          .front());          ///< one of the tasks with gestures (model/jigsaws/gestures.h)
  std::string video;          ///< a video file that OpenCV reads
  std::string transcription;  ///< its gestures, as JIGSAWS has them; empty: nobody knows them
  int every = 3;              ///< one frame in so many is shown, besides the first of each gesture
};

/// A video as the bus sees it: pictures of the size that the networks take, and, with a
/// transcription, what is being done in each. As in data sets made of such videos a frame between
/// two gestures belongs to the one before it; frames before the first gesture are labelled null,
/// those after the last belong to it. One thread. utime of the messages is 0.
class VideoScene {
 public:
  /// Opens the video and reads the transcription, without a picture yet. Throws model::DataError.
  explicit VideoScene(const VideoChoice& choice, std::int64_t episode_id = 0);
  ~VideoScene();

  /// From the beginning again, as episode `episode_id`.
  void Restart(std::int64_t episode_id);
  /// Goes on to the next picture that is shown. False at the end: the last one stays.
  bool Next();

  const task_t& task() const { return task_; }
  /// After the first Next().
  const observation_t& observation() const { return observation_; }
  /// Nothing without a transcription.
  const std::optional<label_t>& label() const { return label_; }

 private:
  bool Shows(int frame) const;
  void Describe(int frame);

  VideoChoice choice_;
  std::optional<model::segments::Segmentation> transcription_;
  std::unique_ptr<report::VideoReader> video_;
  double seconds_per_frame_ = 0;
  int at_ = -1;  // frame of the video that was read last, from 0
  task_t task_{};
  observation_t observation_{};
  std::optional<label_t> label_;
};

/// TASK of the gestures: any may follow any other, for a video says nothing of what may.
task_t GestureTask(const std::string& name, double tick_seconds);

}  // namespace prospect::services

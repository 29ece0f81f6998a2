#pragma once

#include <string>
#include <vector>

#include "model/segments/segmentation.h"

namespace prospect::tools {

// A trial in a folder of videos: two files, of which one may be missing.
struct VideoTrial {
  std::string name;
  std::string video;  // as it should be called where it is missing
  std::string table;  // which actions ran when
};

// A folder of videos with a table each, in one of two layouts:
//   NAME.mp4 (avi, mkv, mov, webm) and NAME.csv (model/segments/segment_csv.h)
//   video/NAME_capture1.avi and transcriptions/NAME.txt, as JIGSAWS has them
//   (model/segments/transcription.h); the right camera's videos and whatever else is there are not
//   read, but that simulated.json marks videos of a simulation
class VideoFolder {
 public:
  // Throws model::DataError where `path` is no such folder, or holds no trial.
  explicit VideoFolder(const std::string& path);

  const std::vector<VideoTrial>& trials() const { return trials_; }  // by their names
  const std::string& world_version() const { return world_version_; }

  bool transcribed() const { return transcribed_; }  // the second layout

  // What the trial's table says. Throws model::DataError.
  model::segments::Segmentation Read(const VideoTrial& trial, const std::vector<std::string>& names,
                                     double frames_per_second) const;

 private:
  bool transcribed_ = false;
  std::string world_version_;
  std::vector<VideoTrial> trials_;
};

}  // namespace prospect::tools

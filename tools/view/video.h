#pragma once

#include <memory>
#include <string>

#include "sim/image.h"

namespace prospect::tools {

// An MPEG-4 video, written picture by picture. Builds without OpenCV have none: making one throws.
class Video {
 public:
  // Throws std::runtime_error if the file cannot be written.
  Video(const std::string& path, double frames_per_second, int width, int height);
  ~Video();

  // `picture` has the video's size.
  void Add(const sim::Image& picture);

  // Call once, after the last picture. Throws std::runtime_error if the file is not whole.
  void Finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace prospect::tools

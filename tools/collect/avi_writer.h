#pragma once

#include <memory>
#include <string>

#include "sim/image.h"

namespace prospect::tools {

// Writes a video file, Motion JPEG in AVI: the same pictures give the same bytes. One thread.
class AviWriter {
 public:
  // Throws std::runtime_error if the file cannot be written.
  AviWriter(const std::string& path, int width, int height, double frames_per_second);
  ~AviWriter();
  AviWriter(const AviWriter&) = delete;
  AviWriter& operator=(const AviWriter&) = delete;

  // `image` must have the video's size.
  void Write(const sim::Image& image);

  // Ends the file, reads it again to see that all of it is there, and gives it its name; throws
  // std::runtime_error if it is not whole, as on a full disk (OpenCV says nothing of that).
  void Finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Frames of a video file by its own count; 0 if there is none that can be read.
int FramesOfVideo(const std::string& path);

}  // namespace prospect::tools

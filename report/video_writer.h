#pragma once

#include <memory>
#include <string>

#include "sim/image.h"

namespace prospect::report {

/// What a video file holds.
enum class VideoFormat {
  kMp4,         ///< H.264 in MPEG-4, which browsers play
  kMotionJpeg,  ///< Motion JPEG in AVI: the same pictures give the same bytes
};

/// A video file, written picture by picture; it takes its name in Finish(), when it is whole. One
/// thread.
class VideoWriter {
 public:
  /// @param frames_per_second above 0 @param width,height of all pictures, pixels. Throws
  /// base::DiskError if the file cannot be written.
  VideoWriter(const std::string& path, double frames_per_second, int width, int height,
              VideoFormat format = VideoFormat::kMp4);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// Throws std::logic_error for a picture of another size than the video's.
  void Add(const sim::Image& picture);

  /// Call once, after the last picture. Looks whether all of it is on the disk, of which OpenCV
  /// says nothing. Throws base::DiskError if it is not.
  void Finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Keeps OpenCV's work in the calling thread, in this process: for processes that share the cores
/// already.
void UseOneThread();

}  // namespace prospect::report

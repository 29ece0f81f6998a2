#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace prospect::report {

/// A video read once from its beginning, in constant memory. One thread.
class VideoReader {
 public:
  /// Throws model::DataError naming the file if it is missing or no video that OpenCV reads.
  explicit VideoReader(const std::string& path);
  ~VideoReader();
  VideoReader(const VideoReader&) = delete;
  VideoReader& operator=(const VideoReader&) = delete;

  /// What the file says of itself; 30 if it says nothing sensible.
  double frames_per_second() const;
  /// Frames of the file by its own count; what can be read may be less. 0: it does not say.
  int frame_count() const;

  /// Goes on by one frame. False at the end, or where the file is damaged.
  bool Next();
  /// The present frame, left camera as it is, as width x height x 3 bytes RGB. False if it is
  /// damaged.
  bool Picture(int width, int height, std::vector<std::uint8_t>* rgb);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Frames of a video file by its own count; 0 if there is none that can be read.
int FramesOfVideo(const std::string& path);

}  // namespace prospect::report

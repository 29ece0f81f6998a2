#include "tools/collect/avi_writer.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>

#include "base/atomic_file.h"
#include "base/disk_error.h"

namespace prospect::tools {

struct AviWriter::Impl {
  explicit Impl(const std::string& name) : path(name), file(name) {}
  std::string path;
  base::AtomicFile file;
  cv::VideoWriter video;
  cv::Mat bgr;
  int frames = 0;
};

AviWriter::AviWriter(const std::string& path, int width, int height, double frames_per_second)
    : impl_(std::make_unique<Impl>(path)) {
  // OpenCV's own encoder damages the last block of one frame in some ten thousand.
  const bool opened = impl_->video.open(impl_->file.temporary(), cv::CAP_FFMPEG,
                                        cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                                        frames_per_second, cv::Size(width, height));
  if (!opened) {
    throw std::runtime_error("cannot write " + path +
                             ": no place to write, or OpenCV was built without FFmpeg");
  }
}

AviWriter::~AviWriter() = default;

void AviWriter::Write(const sim::Image& image) {
  const cv::Mat rgb(image.height, image.width, CV_8UC3,
                    const_cast<std::uint8_t*>(image.rgb.data()));
  cv::cvtColor(rgb, impl_->bgr, cv::COLOR_RGB2BGR);
  impl_->video.write(impl_->bgr);
  ++impl_->frames;
}

void AviWriter::Finish() {
  impl_->video.release();
  cv::VideoCapture video(impl_->file.temporary());
  int whole = 0;
  while (video.grab()) ++whole;
  if (whole != impl_->frames) {
    throw base::DiskError("cannot write " + impl_->path + ": of " + std::to_string(impl_->frames) +
                          " frames " + std::to_string(whole) + " can be read; is the disk full?");
  }
  impl_->file.Commit();
}

int FramesOfVideo(const std::string& path) {
  const cv::VideoCapture video(path);
  return video.isOpened() ? static_cast<int>(video.get(cv::CAP_PROP_FRAME_COUNT)) : 0;
}

}  // namespace prospect::tools

#include "tools/view/video.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>

#include "tools/common/video_codec.h"
#include "tools/common/whole_mp4.h"

namespace prospect::tools {

struct Video::Impl {
  cv::VideoWriter writer;
  std::string path;
};

Video::Video(const std::string& path, double frames_per_second, int width, int height)
    : impl_(std::make_unique<Impl>()) {
  impl_->path = path;
  impl_->writer.open(path, kVideoCodec, frames_per_second, cv::Size(width, height));
  if (!impl_->writer.isOpened()) throw std::runtime_error("cannot write the video " + path);
}

Video::~Video() = default;

void Video::Finish() {
  impl_->writer.release();
  if (!IsWholeMp4(impl_->path)) {
    throw std::runtime_error("cannot write " + impl_->path + ": is the disk full?");
  }
}

void Video::Add(const sim::Image& picture) {
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                    const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  impl_->writer.write(bgr);
}

}  // namespace prospect::tools

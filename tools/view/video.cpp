#include "tools/view/video.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>

#include "base/atomic_file.h"
#include "base/disk_error.h"
#include "tools/common/video_codec.h"
#include "tools/common/whole_mp4.h"

namespace prospect::tools {

struct Video::Impl {
  explicit Impl(const std::string& name) : path(name), file(name) {}
  std::string path;
  base::AtomicFile file;
  cv::VideoWriter writer;
};

Video::Video(const std::string& path, double frames_per_second, int width, int height)
    : impl_(std::make_unique<Impl>(path)) {
  impl_->writer.open(impl_->file.temporary(), kVideoCodec, frames_per_second,
                     cv::Size(width, height));
  if (!impl_->writer.isOpened()) throw std::runtime_error("cannot write the video " + path);
}

Video::~Video() = default;

void Video::Finish() {
  impl_->writer.release();
  if (!IsWholeMp4(impl_->file.temporary()))
    throw base::DiskError("cannot write " + impl_->path + ": is the disk full?");
  impl_->file.Commit();
}

void Video::Add(const sim::Image& picture) {
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                    const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  impl_->writer.write(bgr);
}

}  // namespace prospect::tools

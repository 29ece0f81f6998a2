#include "report/video_writer.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>

#include "base/atomic_file.h"
#include "base/disk_error.h"
#include "report/whole_mp4.h"

namespace prospect::report {
namespace {

int CodecOf(VideoFormat format) {
  return format == VideoFormat::kMp4 ? cv::VideoWriter::fourcc('a', 'v', 'c', '1')
                                     : cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
}

int FramesThatCanBeRead(const std::string& path) {
  cv::VideoCapture video(path);
  int frames = 0;
  while (video.grab()) ++frames;
  return frames;
}

}  // namespace

struct VideoWriter::Impl {
  Impl(const std::string& name, cv::Size picture_size, VideoFormat video_format)
      : path(name), file(name), size(picture_size), format(video_format) {}

  std::string path;
  base::AtomicFile file;
  cv::Size size;
  VideoFormat format;
  cv::VideoWriter writer;
  cv::Mat bgr;
  int frames = 0;
};

VideoWriter::VideoWriter(const std::string& path, double frames_per_second, int width, int height,
                         VideoFormat format)
    : impl_(std::make_unique<Impl>(path, cv::Size(width, height), format)) {
  // FFmpeg's encoders: OpenCV's own Motion JPEG damages the last block of one frame in some ten
  // thousand.
  const bool opened = impl_->writer.open(impl_->file.temporary(), cv::CAP_FFMPEG, CodecOf(format),
                                         frames_per_second, impl_->size);
  if (opened) return;
  throw base::DiskError("cannot write the video " + path +
                        ": no place to write, or OpenCV has no FFmpeg with its encoder");
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::Add(const sim::Image& picture) {
  if (cv::Size(picture.width, picture.height) != impl_->size)
    throw std::logic_error("a picture of another size than the video " + impl_->path);
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                    const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::cvtColor(rgb, impl_->bgr, cv::COLOR_RGB2BGR);
  impl_->writer.write(impl_->bgr);
  ++impl_->frames;
}

void VideoWriter::Finish() {
  impl_->writer.release();
  const std::string& written = impl_->file.temporary();
  const bool whole = impl_->format == VideoFormat::kMp4
                         ? IsWholeMp4(written)
                         : FramesThatCanBeRead(written) == impl_->frames;
  if (!whole) throw base::DiskError("cannot write " + impl_->path + ": is the disk full?");
  impl_->file.Commit();
}

void UseOneThread() { cv::setNumThreads(1); }

}  // namespace prospect::report

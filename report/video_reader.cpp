#include "report/video_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "model/dataset.h"

namespace prospect::report {
namespace {

// Our messages say what is wrong; FFmpeg's own would come between them.
void Quiet() {
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", /*overwrite=*/0);
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

}  // namespace

struct VideoReader::Impl {
  cv::VideoCapture capture;
  cv::Mat frame, small, rgb;
};

VideoReader::VideoReader(const std::string& path) : impl_(std::make_unique<Impl>()) {
  if (!std::filesystem::is_regular_file(path)) throw model::DataError(path + ": is missing");
  Quiet();
  if (impl_->capture.open(path, cv::CAP_FFMPEG) || impl_->capture.open(path)) return;
  throw model::DataError(path + ": is no video that can be read");
}

VideoReader::~VideoReader() = default;

double VideoReader::frames_per_second() const {
  const double fps = impl_->capture.get(cv::CAP_PROP_FPS);
  return std::isfinite(fps) && fps >= 1 && fps <= 1000 ? fps : 30.0;
}

int VideoReader::frame_count() const {
  const double count = impl_->capture.get(cv::CAP_PROP_FRAME_COUNT);
  return std::isfinite(count) && count > 0 && count < 1e9 ? static_cast<int>(count) : 0;
}

bool VideoReader::Next() { return impl_->capture.grab(); }

bool VideoReader::Picture(int width, int height, std::vector<std::uint8_t>* rgb) {
  Impl& v = *impl_;
  if (!v.capture.retrieve(v.frame) || v.frame.type() != CV_8UC3) return false;
  cv::resize(v.frame, v.small, cv::Size(width, height), 0, 0, cv::INTER_AREA);
  cv::cvtColor(v.small, v.rgb, cv::COLOR_BGR2RGB);
  rgb->assign(v.rgb.data, v.rgb.data + static_cast<std::size_t>(width) * height * 3);
  return true;
}

int FramesOfVideo(const std::string& path) {
  try {
    return VideoReader(path).frame_count();
  } catch (const model::DataError&) {
    return 0;
  }
}

}  // namespace prospect::report

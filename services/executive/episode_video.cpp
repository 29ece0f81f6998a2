#include "services/executive/episode_video.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>

#include "base/atomic_file.h"
#include "base/disk_error.h"
#include "tools/common/video_codec.h"
#include "tools/common/whole_mp4.h"

namespace prospect::services {

using namespace agent;

namespace {

constexpr int kEnlargedSide = 448;

cv::Mat Enlarged(const Picture& picture) {
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                    const_cast<std::uint8_t*>(picture.rgb.data()));
  const int scale = std::max(1, kEnlargedSide / std::max(picture.width, picture.height));
  cv::Mat large, bgr;
  cv::resize(rgb, large, {}, scale, scale, cv::INTER_CUBIC);
  cv::cvtColor(large, bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

}  // namespace

void WriteEpisodeVideo(const EpisodeRecord& record, const std::string& path) {
  if (record.frames.empty()) return;
  const cv::Mat first = Enlarged(record.frames.front());
  base::AtomicFile file(path);
  cv::VideoWriter video(file.temporary(), tools::kVideoCodec, record.frames_per_second,
                        first.size());
  if (!video.isOpened())
    throw std::runtime_error("cannot write " + path + ": no H.264 encoder, or no place to write");
  for (const auto& frame : record.frames) video.write(Enlarged(frame));
  video.release();
  if (!tools::IsWholeMp4(file.temporary()))
    throw base::DiskError("cannot write " + path + ": is the disk full?");
  file.Commit();
}

}  // namespace prospect::services

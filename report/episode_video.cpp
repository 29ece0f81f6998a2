#include "report/episode_video.h"

#include <algorithm>

#include "report/image_edit.h"
#include "report/video_writer.h"

namespace prospect::report {
namespace {

constexpr int kEnlargedSide = 448;

sim::Image Enlarged(const sim::Image& picture) {
  const int factor = std::max(1, kEnlargedSide / std::max(picture.width, picture.height));
  return Resized(picture, factor * picture.width, factor * picture.height);
}

}  // namespace

void WriteEpisodeVideo(const agent::EpisodeRecord& record, const std::string& path) {
  if (record.frames.empty()) return;
  const sim::Image first = Enlarged(record.frames.front());
  VideoWriter video(path, record.frames_per_second, first.width, first.height);
  for (const sim::Image& frame : record.frames) video.Add(Enlarged(frame));
  video.Finish();
}

}  // namespace prospect::report

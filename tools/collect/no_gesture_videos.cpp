// For builds without OpenCV.

#include "tools/collect/collector.h"
#include "tools/collect/gesture_videos.h"

namespace prospect::tools {

GestureVideoSummary CollectGestureVideos(const cli::CollectOptions&) {
  throw CollectUsageError("this build writes no videos: it was made without OpenCV");
}

}  // namespace prospect::tools

// For builds without OpenCV.

#include <stdexcept>

#include "tools/view/video.h"

namespace prospect::tools {

struct Video::Impl {};

Video::Video(const std::string&, double, int, int) {
  throw std::runtime_error("this build has no video: it was made without OpenCV");
}

Video::~Video() = default;

void Video::Add(const sim::Image&) {}

void Video::Finish() {}

}  // namespace prospect::tools

#include "report/image_edit.h"

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

namespace prospect::report {

sim::Image Enlarge(const sim::Image& image, int factor) {
  sim::Image large{image.width * factor, image.height * factor, {}};
  large.rgb.resize(static_cast<std::size_t>(large.width) * large.height * 3);
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) {
      const std::size_t from =
          (static_cast<std::size_t>(y / factor) * image.width + x / factor) * 3;
      const std::size_t to = (static_cast<std::size_t>(y) * large.width + x) * 3;
      std::copy_n(&image.rgb[from], 3, &large.rgb[to]);
    }
  }
  return large;
}

namespace {

sim::Image SizedBy(int way, const sim::Image& image, int width, int height) {
  const cv::Mat from(image.height, image.width, CV_8UC3,
                     const_cast<std::uint8_t*>(image.rgb.data()));
  sim::Image resized{width, height, {}};
  resized.rgb.resize(static_cast<std::size_t>(width) * height * 3);
  cv::Mat to(height, width, CV_8UC3, resized.rgb.data());
  cv::resize(from, to, to.size(), 0, 0, way);
  return resized;
}

}  // namespace

sim::Image Resized(const sim::Image& image, int width, int height) {
  return SizedBy(cv::INTER_CUBIC, image, width, height);
}

sim::Image Scaled(const sim::Image& image, int width, int height) {
  return SizedBy(cv::INTER_AREA, image, width, height);
}

void Paste(const sim::Image& tile, int x, int y, sim::Image* canvas) {
  const int first = std::max(0, -x);
  const int last = std::min(tile.width, canvas->width - x);
  if (first >= last) return;
  for (int row = std::max(0, -y); row < std::min(tile.height, canvas->height - y); ++row) {
    const std::size_t from = (static_cast<std::size_t>(row) * tile.width + first) * 3;
    const std::size_t to = (static_cast<std::size_t>(row + y) * canvas->width + x + first) * 3;
    std::copy_n(&tile.rgb[from], static_cast<std::size_t>(last - first) * 3, &canvas->rgb[to]);
  }
}

double MeanAbsoluteError(const sim::Image& a, const sim::Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
  return a.rgb.empty() ? 0 : sum / 255 / static_cast<double>(a.rgb.size());
}

}  // namespace prospect::report

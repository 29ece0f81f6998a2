#include "services/executive/canvas.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <vector>

#include "base/atomic_file.h"

namespace prospect::services {

using namespace agent;

namespace {

constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr int kMostWidth = 1900;
const cv::Scalar kPaper(255, 255, 255);
const cv::Scalar kEmpty(232, 232, 232);

int Thickness(const Canvas::Style& style) { return style.bold ? 2 : 1; }
int LineHeight(const Canvas::Style& style) { return static_cast<int>(40 * style.size) + 4; }

}  // namespace

Canvas::Canvas(int width) : sheet_(64, width, CV_8UC3, kPaper) {}

int Canvas::PerRow(int count, int cell, int others) {
  const int fit = std::max(1, (kMostWidth - others) / cell);
  const int rows = (std::max(1, count) + fit - 1) / fit;
  return (std::max(1, count) + rows - 1) / rows;
}

void Canvas::Grow(int height) {
  if (height <= sheet_.rows) return;
  const cv::Mat more(height + 256 - sheet_.rows, sheet_.cols, CV_8UC3, kPaper);
  sheet_.push_back(more);
}

cv::Size Canvas::Extent(const std::string& text, const Style& style) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, style.size, Thickness(style), &baseline);
}

int Canvas::Text(int x, int y, const std::string& text, const Style& style) {
  const int bottom = y + LineHeight(style);
  Grow(bottom);
  const int base = y + static_cast<int>(30 * style.size);
  cv::putText(sheet_, text, {x, base}, kFont, style.size, style.color, Thickness(style),
              cv::LINE_AA);
  return bottom;
}

int Canvas::Paragraph(int x, int y, int width, const std::string& text, const Style& style) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) {
    const std::string longer = line.empty() ? word : line + ' ' + word;
    if (!line.empty() && Extent(longer, style).width > width) {
      y = Text(x, y, line, style);
      line = word;
    } else {
      line = longer;
    }
  }
  return line.empty() ? y : Text(x, y, line, style);
}

void Canvas::Image(int x, int y, int side, const Picture& picture, const cv::Scalar& color) {
  const int longer = std::max({1, picture.width, picture.height});
  const int width = picture.empty() ? side : side * picture.width / longer;
  const int height = picture.empty() ? side : side * picture.height / longer;
  Grow(y + height + 4);
  const cv::Rect place(x, y, width, height);
  if (picture.empty()) {
    cv::rectangle(sheet_, place, kEmpty, cv::FILLED);
  } else {
    const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                      const_cast<std::uint8_t*>(picture.rgb.data()));
    cv::Mat large, bgr;
    cv::resize(rgb, large, place.size(), 0, 0, cv::INTER_CUBIC);
    cv::cvtColor(large, bgr, cv::COLOR_RGB2BGR);
    bgr.copyTo(sheet_(place));
  }
  cv::rectangle(sheet_, {x - 2, y - 2, width + 4, height + 4}, color, 2, cv::LINE_8);
}

void Canvas::Line(int x0, int x1, int y, const cv::Scalar& color) {
  Grow(y + 1);
  cv::line(sheet_, {x0, y}, {x1, y}, color, 1);
}

void Canvas::Write(const std::string& path, int height) {
  Grow(height);
  std::vector<unsigned char> png;
  cv::imencode(".png", sheet_.rowRange(0, height), png);
  base::WriteFile(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace prospect::services

#include "report/canvas.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "report/image_edit.h"

namespace prospect::report {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr int kGrowBy = 256;  // pixels, so that the paper is not copied at every line

cv::Scalar Of(const Color& color) { return {double(color.r), double(color.g), double(color.b)}; }

int Thickness(const Style& style) { return style.bold ? 2 : 1; }

// The pixels of an image as OpenCV sees them, not copied.
cv::Mat View(sim::Image* image) {
  return {image->height, image->width, CV_8UC3, image->rgb.data()};
}

}  // namespace

Canvas::Canvas(int width) : image_{width, 0, {}} { Grow(kGrowBy); }

void Canvas::Grow(int height) {
  if (height <= image_.height) return;
  image_.height = height + kGrowBy;
  image_.rgb.resize(static_cast<std::size_t>(image_.width) * image_.height * 3, 255);
}

int Canvas::TextWidth(const std::string& text, const Style& style) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, style.size, Thickness(style), &baseline).width;
}

int Canvas::LineHeight(const Style& style) { return static_cast<int>(40 * style.size) + 3; }

int Canvas::Text(int x, int y, const std::string& text, const Style& style) {
  const int bottom = y + LineHeight(style);
  Grow(bottom);
  cv::putText(View(&image_), text, {x, y + static_cast<int>(30 * style.size)}, kFont, style.size,
              Of(style.color), Thickness(style), cv::LINE_AA);
  return bottom;
}

int Canvas::Centered(int x, int y, const std::string& text, const Style& style) {
  return Text(x - TextWidth(text, style) / 2, y, text, style);
}

int Canvas::EndingAt(int x, int y, const std::string& text, const Style& style) {
  return Text(x - TextWidth(text, style), y, text, style);
}

int Canvas::Paragraph(int x, int y, int width, const std::string& text, const Style& style) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) {
    const std::string longer = line.empty() ? word : line + ' ' + word;
    if (!line.empty() && TextWidth(longer, style) > width) {
      y = Text(x, y, line, style);
      line = word;
    } else {
      line = longer;
    }
  }
  return line.empty() ? y : Text(x, y, line, style);
}

void Canvas::TextUpwards(int x, int y, const std::string& text, const Style& style) {
  Canvas flat(TextWidth(text, style) + 2);
  const int height = flat.Text(1, 0, text, style);
  sim::Image lying = flat.Cut(height);
  cv::Mat turned;
  cv::rotate(View(&lying), turned, cv::ROTATE_90_COUNTERCLOCKWISE);
  const sim::Image standing{turned.cols, turned.rows, {turned.datastart, turned.dataend}};
  Picture(x, y - standing.height / 2, standing, 1);
}

void Canvas::Picture(int x, int y, const sim::Image& picture, int factor) {
  Grow(y + picture.height * factor);
  Paste(Enlarge(picture, factor), x, y, &image_);
}

void Canvas::Framed(int x, int y, int side, const sim::Image& picture, const Color& color) {
  const int longer = std::max({1, picture.width, picture.height});
  const int width = picture.empty() ? side : side * picture.width / longer;
  const int height = picture.empty() ? side : side * picture.height / longer;
  if (picture.empty()) {
    Fill(x, y, width, height, kPale);
  } else {
    Picture(x, y, Resized(picture, width, height), 1);
  }
  Frame(x, y, width, height, color, 2);
}

void Canvas::Frame(int x, int y, int width, int height, const Color& color, int thickness) {
  const int t = thickness;
  Fill(x - t, y - t, width + 2 * t, t, color);
  Fill(x - t, y + height, width + 2 * t, t, color);
  Fill(x - t, y, t, height, color);
  Fill(x + width, y, t, height, color);
}

void Canvas::Fill(int x, int y, int width, int height, const Color& color) {
  if (width <= 0 || height <= 0) return;
  Grow(y + height);
  cv::rectangle(View(&image_), cv::Rect(x, y, width, height), Of(color), cv::FILLED);
}

void Canvas::Line(int x0, int y0, int x1, int y1, const Color& color, int thickness) {
  Grow(std::max(y0, y1) + thickness);
  cv::line(View(&image_), {x0, y0}, {x1, y1}, Of(color), thickness, cv::LINE_AA);
}

void Canvas::Dot(int x, int y, int radius, const Color& color) {
  Grow(y + radius + 1);
  cv::circle(View(&image_), {x, y}, radius, Of(color), cv::FILLED, cv::LINE_AA);
}

int Canvas::PerRow(int count, int cell, int others) {
  const int fit = std::max(1, (kMostWidth - others) / cell);
  const int rows = (std::max(1, count) + fit - 1) / fit;
  return (std::max(1, count) + rows - 1) / rows;
}

sim::Image Canvas::Cut(int height) {
  Grow(height);
  sim::Image cut{image_.width, height, {}};
  cut.rgb.assign(image_.rgb.begin(),
                 image_.rgb.begin() + static_cast<std::ptrdiff_t>(cut.width) * height * 3);
  return cut;
}

}  // namespace prospect::report

#include "report/plot.h"

#include <algorithm>
#include <cmath>

namespace prospect::report {

double Axis::Share(double value) const {
  if (scale == Scale::kLinear) return std::clamp((value - low) / (high - low), 0.0, 1.0);
  const double at = std::log2(std::max(value, low) / low);
  return std::clamp(at / std::log2(high / low), 0.0, 1.0);
}

Plot::Plot(Canvas* canvas, int left, int top, int width, int height, const Axis& x, const Axis& y)
    : canvas_(canvas), left_(left), top_(top), width_(width), height_(height), x_(x), y_(y) {}

int Plot::X(double value) const {
  return left_ + static_cast<int>(std::lround(x_.Share(value) * width_));
}

int Plot::Y(double value) const {
  return top_ + height_ - static_cast<int>(std::lround(y_.Share(value) * height_));
}

void Plot::TickX(double value, const std::string& words) {
  canvas_->Line(X(value), top_, X(value), top_ + height_, kPale, 1);
  canvas_->Centered(X(value), top_ + height_ + 4, words, kTickStyle);
}

void Plot::TickY(double value, const std::string& words) {
  canvas_->Line(left_, Y(value), left_ + width_, Y(value), kPale, 1);
  canvas_->EndingAt(left_ - 6, Y(value) - 7, words, kTickStyle);
}

void Plot::NameX(const std::string& words) {
  canvas_->Centered(left_ + width_ / 2, top_ + height_ + 20, words, kTickStyle);
}

void Plot::NameY(const std::string& words) {
  canvas_->TextUpwards(left_ - kPlotLeft + 2, top_ + height_ / 2, words, kTickStyle);
}

void Plot::Frame() { canvas_->Frame(left_, top_, width_, height_, kFaint, 1); }

void Plot::Line(double x0, double y0, double x1, double y1, const Color& color, int thickness) {
  canvas_->Line(X(x0), Y(y0), X(x1), Y(y1), color, thickness);
}

void Plot::DashedLine(double y, const Color& color) {
  for (int x = left_; x < left_ + width_; x += 10) canvas_->Line(x, Y(y), x + 5, Y(y), color, 1);
}

void Plot::Dot(double x, double y, int radius, const Color& color) {
  canvas_->Dot(X(x), Y(y), radius, color);
}

}  // namespace prospect::report

#pragma once

#include <string>

#include "report/canvas.h"

namespace prospect::report {

/// One direction of a plot: what lies at its two ends, and whether equal steps add or multiply.
struct Axis {
  enum class Scale { kLinear, kLogarithmic };
  double low = 0, high = 1;  ///< logarithmic: above 0
  Scale scale = Scale::kLinear;

  /// Where a value lies, 0 (low) to 1 (high); values outside are cut to that.
  double Share(double value) const;
};

inline constexpr Style kTickStyle{0.38, kFaint, false};

/// Room that a plot wants beside its area, pixels.
inline constexpr int kPlotLeft = 58;   ///< numbers and name of the upright axis
inline constexpr int kPlotBelow = 40;  ///< numbers and name of the lying axis

/// The area of a plot on a canvas, in the units of its two axes. The canvas must outlive it. One
/// thread.
class Plot {
 public:
  /// @param left,top,width,height of the area, pixels
  Plot(Canvas* canvas, int left, int top, int width, int height, const Axis& x, const Axis& y);

  /// Where values lie on the canvas, pixels.
  int X(double value) const;
  int Y(double value) const;

  /// A pale line across the area at a value, with words beside the axis.
  void TickX(double value, const std::string& words);
  void TickY(double value, const std::string& words);
  void NameX(const std::string& words);
  void NameY(const std::string& words);
  void Frame();

  void Line(double x0, double y0, double x1, double y1, const Color& color, int thickness);
  /// Across the area at the height of `y`.
  void DashedLine(double y, const Color& color);
  void Dot(double x, double y, int radius, const Color& color);

 private:
  Canvas* canvas_;
  int left_, top_, width_, height_;
  Axis x_, y_;
};

}  // namespace prospect::report

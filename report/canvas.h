#pragma once

#include <string>

#include "report/color.h"
#include "sim/image.h"

namespace prospect::report {

/// How a line of text looks.
struct Style {
  double size = 0.45;  ///< 1 is about 30 pixels high
  Color color = kInk;
  bool bold = false;
};

inline constexpr Style kTitleStyle{0.75, kInk, false};
inline constexpr Style kHeadStyle{0.5, kInk, false};
inline constexpr Style kBodyStyle{0.45, kInk, false};
inline constexpr Style kSmallStyle{0.4, kFaint, false};

inline constexpr int kMostWidth = 1900;  ///< pixels; a screen shows as many

/// White paper of a fixed width to draw on, which grows downwards as needed. Coordinates are pixels
/// from the upper left corner; what lies beside the paper is cut off. One thread.
class Canvas {
 public:
  explicit Canvas(int width);

  /// One line with its upper left corner at (x, y), ASCII only. Returns the y below it.
  int Text(int x, int y, const std::string& text, const Style& style);
  /// The same, its middle at x.
  int Centered(int x, int y, const std::string& text, const Style& style);
  /// The same, its end at x.
  int EndingAt(int x, int y, const std::string& text, const Style& style);
  /// Broken between words to fit `width`; a longer word is drawn as it is. Returns the y below.
  int Paragraph(int x, int y, int width, const std::string& text, const Style& style);
  /// Reading from below upwards, its middle at height `y`.
  void TextUpwards(int x, int y, const std::string& text, const Style& style);

  /// Every pixel `factor` x `factor` times.
  void Picture(int x, int y, const sim::Image& picture, int factor);
  /// Enlarged smoothly so that its longer side is `side`, with a frame of `color`. An empty picture
  /// is a grey square.
  void Framed(int x, int y, int side, const sim::Image& picture, const Color& color);
  /// A frame of `thickness` pixels around (outside of) a box.
  void Frame(int x, int y, int width, int height, const Color& color, int thickness);
  void Fill(int x, int y, int width, int height, const Color& color);
  void Line(int x0, int y0, int x1, int y1, const Color& color, int thickness);
  void Dot(int x, int y, int radius, const Color& color);

  int width() const { return image_.width; }
  /// What was drawn, cut at `height`.
  sim::Image Cut(int height);

  static int TextWidth(const std::string& text, const Style& style);
  static int LineHeight(const Style& style);

  /// How many of `count` cells of `cell` pixels stand side by side: as many as fit, beside `others`
  /// pixels, a picture of kMostWidth, and so that all rows hold about as many. At least 1.
  static int PerRow(int count, int cell, int others);

 private:
  void Grow(int height);

  sim::Image image_;
};

}  // namespace prospect::report

#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "agent/picture.h"

namespace prospect::services {

/// A white sheet to draw on that grows downwards as needed. Coordinates are pixels from the top
/// left. One thread.
class Canvas {
 public:
  struct Style {
    double size = 0.45;                         ///< 1 is about 30 pixels high
    cv::Scalar color = cv::Scalar(40, 40, 40);  ///< blue, green, red
    bool bold = false;
  };

  explicit Canvas(int width);

  /// One line, its top left corner at (x, y). Characters outside ASCII are not drawn. @return the y
  /// below it
  int Text(int x, int y, const std::string& text, const Style& style);

  /// Broken between words to fit `width`. @return the y below the last line
  int Paragraph(int x, int y, int width, const std::string& text, const Style& style);

  /// A picture enlarged so that its longer side is `side`, at (x, y), with a frame of `color`. An
  /// empty picture is a grey square that says so.
  void Image(int x, int y, int side, const agent::Picture& picture, const cv::Scalar& color);

  void Line(int x0, int x1, int y, const cv::Scalar& color);

  int width() const { return sheet_.cols; }

  /// How many of `count` cells of `cell` pixels stand side by side: as many as fit, beside `others`
  /// pixels, a sheet of 1,900 pixels, which a screen shows; and so that all rows hold about as
  /// many. At least 1.
  static int PerRow(int count, int cell, int others);

  /// Cuts the sheet at `height` and writes a PNG. Throws std::runtime_error.
  void Write(const std::string& path, int height);

 private:
  void Grow(int height);
  static cv::Size Extent(const std::string& text, const Style& style);

  cv::Mat sheet_;
};

}  // namespace prospect::services

#pragma once

#include <string>
#include <vector>

#include "report/canvas.h"
#include "sim/image.h"

namespace prospect::report {

/// One step of an imagined course of action as it is drawn.
struct Cell {
  std::string above;  ///< the action
  sim::Image picture;
  std::vector<std::string> below;  ///< V, f
  bool bad = false;                ///< a red frame
};

/// An imagined course of action: a picture a step, and what became of it.
struct Strip {
  std::string heading;
  std::vector<Cell> cells;
  std::string verdict;
  Color color = kInk;  ///< of heading and verdict
};

/// Draws strips from `y` on, line after line, as many in a line as fit the canvas. Returns the y
/// below.
int DrawStrips(Canvas* canvas, int y, const std::vector<Strip>& strips);
/// How wide a canvas should be for these: about nine pictures.
int StripsWidth(const std::vector<Strip>& strips);

}  // namespace prospect::report

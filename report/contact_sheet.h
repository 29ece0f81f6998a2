#pragma once

#include <string>
#include <vector>

#include "sim/image.h"

namespace prospect::report {

/// A contact sheet: pictures in rows, with words.
struct ContactSheet {
  struct Cell {
    sim::Image picture;  ///< all of one size
    std::string words;   ///< under it
  };
  struct Row {
    std::string heading;
    std::vector<Cell> cells;
  };
  std::string title;
  std::vector<Row> rows;  ///< at least one with a picture
};

/// At most kMostWidth (canvas.h) wide: a row of more pictures goes on below. Small pictures are
/// enlarged so that words fit under them.
sim::Image Draw(const ContactSheet& sheet);

}  // namespace prospect::report

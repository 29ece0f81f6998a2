#pragma once

#include <vector>

#include "sim/image.h"

namespace prospect::tools {

// Mean absolute errors (0 to 1) of one picture foretold for every repetition of a moment: the one
// that has the median of the repetitions in each number, which errs least.
struct PictureErrors {
  bool known = false;    // whether there are pictures to foretell and to be foretold by
  double foretold = 0;   // of the first half's medians from the second half's pictures: a little
                         // more than must be, since few repetitions tell a median only roughly
  double in_itself = 0;  // of the medians of all from all: a little less
};

// Pictures of one size; otherwise std::invalid_argument.
PictureErrors ErrorsOf(const std::vector<sim::Image>& first, const std::vector<sim::Image>& second);

}  // namespace prospect::tools

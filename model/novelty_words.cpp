#include "model/novelty_words.h"

#include <algorithm>
#include <cmath>

#include "base/number_format.h"

namespace prospect::model {
namespace {

using base::Number;

/// "3.00 times" and what is usual, with enough digits to tell the two apart.
std::string Compared(double value, const char* unit, double limit) {
  const char* format = std::abs(value - limit) < 0.01 ? "%.4f" : unit[0] ? "%.2f" : "%.3f";
  return Number(format, value) + unit + ", 99 % of known pictures stay below " +
         Number(format, limit);
}

}  // namespace

std::string DescribeNovelty(const Novelty& novelty) {
  const std::string p = "p " + Number("%.2g", novelty.p) + ": ";
  const double redrawing = novelty.residual / std::max(1e-9, novelty.residual_limit);
  const double reading = novelty.state / std::max(1e-9, novelty.state_limit);
  if (reading > redrawing) {
    return p + "its hidden state lies " +
           Compared(novelty.state, " times as far out as usual", novelty.state_limit);
  }
  // The mean error is what people can see; it need not stand out where a part of a picture does.
  return p + "it cannot be redrawn: " +
         (novelty.error > novelty.error_limit
              ? "error " + Compared(novelty.error, "", novelty.error_limit)
              : "parts of it differ " +
                    Compared(novelty.residual, " times as much as usual", novelty.residual_limit));
}

std::string NoveltyRefusal(const Novelty& novelty) {
  return "this picture is unlike what the networks were trained on (" + DescribeNovelty(novelty) +
         ")";
}

}  // namespace prospect::model

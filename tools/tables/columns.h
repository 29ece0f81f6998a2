#pragma once

#include <array>
#include <cstddef>

namespace prospect::tools {

/// What one example is measured by. Labels are 0 or 1: is the picture labelled with its action?
/// Errors are mean absolute differences of pixels (0..1) from the clean goal picture.
enum Column : std::size_t {
  kX1Label,     ///< of the first predicted picture, by the judge (the second classifier)
  kX1Error,     ///<
  kX2Label,     ///< of the second
  kX2Error,     ///<
  kX1Psnr,      ///< peak signal-to-noise ratio, dB (model/training/picture_measures.h)
  kX2Psnr,      ///<
  kX1Ssim,      ///< structural similarity
  kX2Ssim,      ///<
  kX1Composed,  ///< error of ComposePicture (model/networks/light.h)
  kX2Composed,  ///<
  kX2LabelOfC,  ///< label by C itself, which stands in the loss of some variants
  kColumns
};

/// Sums over the examples of one trial, and how many there were.
struct TrialSums {
  double examples = 0;
  double extras = 0;    ///< of these, the examples that the composed columns were taken of
  double by_c = 0;      ///< and those that C labelled
  double labelled = 0;  ///< examples that a judge labelled: all of them, where there is one
  std::array<double, kColumns> sum{};

  void Add(const TrialSums& o) {
    examples += o.examples;
    extras += o.extras;
    by_c += o.by_c;
    labelled += o.labelled;
    for (std::size_t c = 0; c < kColumns; ++c) sum[c] += o.sum[c];
  }
  /// Number of examples behind a column.
  double Count(std::size_t column) const {
    if (column == kX2LabelOfC) return by_c;
    if (column == kX1Label || column == kX2Label) return labelled;
    return column >= kX1Composed ? extras : examples;
  }
};

}  // namespace prospect::tools

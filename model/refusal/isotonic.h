#pragma once

#include <vector>

#include "model/refusal/sample.h"

namespace prospect::model {

/// Scenes of neighbouring scores, and how many of them were solved.
struct SuccessBlock {
  double low = 0, high = 0;  ///< lowest and highest score
  int scenes = 0;
  int solved = 0;
  double share() const { return scenes > 0 ? static_cast<double>(solved) / scenes : 0; }
};

/// How often a plan of some score succeeds, as a step function of the score that never falls: the
/// least-squares fit to what happened to attempted scenes, by pooling adjacent violators (Barlow et
/// al. 1972). Blocks of fewer than `fewest` scenes join the neighbour whose share is nearer, so
/// that no end of the range promises all or nothing on a handful. Immutable.
class SuccessCurve {
 public:
  static constexpr int kFewest = 20;

  explicit SuccessCurve(const CalibrationSample& sample, int fewest = kFewest);

  bool empty() const { return blocks_.empty(); }
  const std::vector<SuccessBlock>& blocks() const { return blocks_; }  ///< scores ascending

  /// The block a score falls into; between two blocks the nearer one, beyond the ends the
  /// outermost. The curve must not be empty.
  const SuccessBlock& At(double score) const;

 private:
  std::vector<SuccessBlock> blocks_;
};

}  // namespace prospect::model

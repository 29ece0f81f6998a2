#include "model/refusal/isotonic.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace prospect::model {
namespace {

using Blocks = std::vector<SuccessBlock>;

// One block a score, ascending.
Blocks BlocksByScore(const CalibrationSample& sample) {
  std::vector<CalibrationScene> scenes;
  for (const CalibrationScene& scene : sample.scenes) {
    if (scene.attempted()) scenes.push_back(scene);
  }
  std::stable_sort(scenes.begin(), scenes.end(),
                   [](const auto& a, const auto& b) { return a.score < b.score; });
  Blocks blocks;
  for (const CalibrationScene& scene : scenes) {
    if (blocks.empty() || blocks.back().high != scene.score)
      blocks.push_back({scene.score, scene.score, 0, 0});
    ++blocks.back().scenes;
    blocks.back().solved += scene.ending == SceneEnding::kSolved;
  }
  return blocks;
}

SuccessBlock Joined(const SuccessBlock& lower, const SuccessBlock& upper) {
  return {lower.low, upper.high, lower.scenes + upper.scenes, lower.solved + upper.solved};
}

// Shares are compared without rounding.
bool Violates(const SuccessBlock& lower, const SuccessBlock& upper) {
  return std::int64_t{lower.solved} * upper.scenes >= std::int64_t{upper.solved} * lower.scenes;
}

Blocks Pooled(const Blocks& blocks) {
  Blocks pooled;
  for (SuccessBlock block : blocks) {
    while (!pooled.empty() && Violates(pooled.back(), block)) {
      block = Joined(pooled.back(), block);
      pooled.pop_back();
    }
    pooled.push_back(block);
  }
  return pooled;
}

// Joins block i to the neighbour whose share is nearer.
void JoinToNeighbour(Blocks* blocks, std::size_t i) {
  const auto gap = [&](std::size_t a, std::size_t b) {
    return std::abs((*blocks)[a].share() - (*blocks)[b].share());
  };
  const bool last = i + 1 == blocks->size();
  const bool down = i > 0 && (last || gap(i - 1, i) <= gap(i, i + 1));
  const std::size_t lower = down ? i - 1 : i;
  (*blocks)[lower] = Joined((*blocks)[lower], (*blocks)[lower + 1]);
  blocks->erase(blocks->begin() + static_cast<std::ptrdiff_t>(lower) + 1);
}

void JoinSmall(Blocks* blocks, int fewest) {
  while (blocks->size() > 1) {
    const auto smallest =
        std::min_element(blocks->begin(), blocks->end(),
                         [](const auto& a, const auto& b) { return a.scenes < b.scenes; });
    if (smallest->scenes >= fewest) return;
    JoinToNeighbour(blocks, static_cast<std::size_t>(smallest - blocks->begin()));
  }
}

}  // namespace

SuccessCurve::SuccessCurve(const CalibrationSample& sample, int fewest)
    : blocks_(Pooled(BlocksByScore(sample))) {
  JoinSmall(&blocks_, fewest);
}

const SuccessBlock& SuccessCurve::At(double score) const {
  std::size_t i = 0;
  while (i + 1 < blocks_.size() && score > (blocks_[i].high + blocks_[i + 1].low) / 2) ++i;
  return blocks_[i];
}

}  // namespace prospect::model

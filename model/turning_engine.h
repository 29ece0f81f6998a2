#pragma once

#include <memory>
#include <span>
#include <vector>

#include "model/engine_decorator.h"

namespace prospect::model {

/// Looks at each picture in several of the eight turns and mirrorings of a square, and answers the
/// mean of what the inner engine says of them. For worlds seen from straight above without a
/// preferred direction, whose networks were trained on all eight: then they differ by error alone.
/// A state holds the states of all turns, one after the other, so an answer stays a pure function
/// of its row, and a row costs as many of the inner engine's. Pictures are painted from the first
/// turn, which is the picture itself. As thread-safe as the inner engine.
class TurningEngine : public EngineDecorator {
 public:
  /// `turns`: 2 to 8. Throws std::invalid_argument where that is not so, or pictures are not
  /// square.
  TurningEngine(std::unique_ptr<Engine> inner, int turns);

  const EngineInfo& info() const override { return info_; }
  std::uint64_t fingerprint() const override;

 protected:
  Hidden DoEncode(Pixels picture) override;
  Prediction DoEvaluate(std::span<const float> h0, std::span<const float> h,
                        int previous_action) override;
  std::vector<Prediction> DoExpand(const std::vector<ExpandInput>& rows) override;
  std::vector<std::vector<std::uint8_t>> DoDecode(const std::vector<Hidden>& states) override;
  std::vector<std::vector<std::uint8_t>> DoDecodeOnto(Pixels seen, std::span<const float> start,
                                                      const std::vector<Hidden>& states) override;

 private:
  std::span<const float> Part(std::span<const float> state, int turn) const;
  std::vector<Hidden> First(const std::vector<Hidden>& states) const;

  const int turns_;
  const int size_;  // of an inner state
  EngineInfo info_;
};

}  // namespace prospect::model

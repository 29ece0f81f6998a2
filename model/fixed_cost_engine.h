#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <vector>

#include "model/engine_decorator.h"

namespace prospect::model {

/// Time that a batch takes: fixed_ms + row_ms x rows, both >= 0.
struct BatchCost {
  double fixed_ms = 4;
  double row_ms = 0.02;
};

/// Makes Evaluate and Expand take a modelled time, as a device does whose fixed cost a batch must
/// carry, by sleeping: so that tests of scaling over many workers are honest on few cores. Where
/// the inner engine needs longer than the model says, its own time counts. One device: calls from
/// several threads wait for each other. Answers are the inner engine's.
class FixedCostEngine : public EngineDecorator {
 public:
  FixedCostEngine(std::unique_ptr<Engine> inner, BatchCost cost);

 protected:
  Prediction DoEvaluate(std::span<const float> h0, std::span<const float> h,
                        int previous_action) override;
  std::vector<Prediction> DoExpand(const std::vector<ExpandInput>& rows) override;

 private:
  using Clock = std::chrono::steady_clock;
  void Pass(Clock::time_point begun, std::size_t rows) const;

  BatchCost cost_;
  std::mutex device_;
};

}  // namespace prospect::model

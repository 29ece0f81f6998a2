#include "model/fixed_cost_engine.h"

#include <stdexcept>
#include <thread>
#include <utility>

namespace prospect::model {

FixedCostEngine::FixedCostEngine(std::unique_ptr<Engine> inner, BatchCost cost)
    : EngineDecorator(std::move(inner)), cost_(cost) {
  if (!(cost.fixed_ms >= 0 && cost.row_ms >= 0))
    throw std::invalid_argument("the cost of a batch must be 0 ms or more");
}

void FixedCostEngine::Pass(Clock::time_point begun, std::size_t rows) const {
  const std::chrono::duration<double, std::milli> cost(cost_.fixed_ms +
                                                       cost_.row_ms * static_cast<double>(rows));
  std::this_thread::sleep_until(begun + std::chrono::duration_cast<Clock::duration>(cost));
}

Prediction FixedCostEngine::DoEvaluate(std::span<const float> h0, std::span<const float> h,
                                       int previous_action) {
  const std::lock_guard<std::mutex> lock(device_);
  const auto begun = Clock::now();
  Prediction answer = inner().Evaluate(h0, h, previous_action);
  Pass(begun, 1);
  return answer;
}

std::vector<Prediction> FixedCostEngine::DoExpand(const std::vector<ExpandInput>& rows) {
  const std::lock_guard<std::mutex> lock(device_);
  const auto begun = Clock::now();
  auto answers = inner().Expand(rows);
  if (!rows.empty()) Pass(begun, rows.size());
  return answers;
}

}  // namespace prospect::model

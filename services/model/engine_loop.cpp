#include "services/model/engine_loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "base/seconds_since.h"

namespace prospect::services {
namespace {

using Clock = std::chrono::steady_clock;

// Sizes of batch i such that the mean over batches is `mean`.
int SizeOf(std::int64_t batch, double mean) {
  const auto up_to = [&](std::int64_t n) {
    return static_cast<std::int64_t>(std::floor(static_cast<double>(n) * mean + 1e-9));
  };
  return std::max(1, static_cast<int>(up_to(batch + 1) - up_to(batch)));
}

double Run(model::Engine& engine, const model::Hidden& root,
           const std::vector<model::Prediction>& states, double mean, double seconds) {
  std::int64_t rows = 0, batches = 0;
  const auto begun = Clock::now();
  while (base::SecondsSince(begun) < seconds) {
    std::vector<model::ExpandInput> inputs;
    for (int i = SizeOf(batches, mean); i > 0; --i, ++rows) {
      const auto& from = states[static_cast<std::size_t>(rows) % states.size()];
      const auto action = static_cast<int>(rows) % engine.info().num_actions;
      inputs.push_back({root, from.h, action});
    }
    engine.Expand(inputs);
    ++batches;
  }
  return static_cast<double>(rows) / base::SecondsSince(begun);
}

}  // namespace

double EngineLoopRate(model::Engine& engine, double mean_batch, double seconds) {
  const auto& info = engine.info();
  const std::vector<std::uint8_t> picture(
      static_cast<std::size_t>(info.image_width * info.image_height * 3), 90);
  const model::Hidden root = engine.Encode(picture);
  std::vector<model::ExpandInput> first;
  for (int a = 0; a < info.num_actions; ++a) first.push_back({root, root, a});
  const auto states = engine.Expand(first);
  Run(engine, root, states, mean_batch, seconds / 6);
  return Run(engine, root, states, mean_batch, seconds);
}

}  // namespace prospect::services

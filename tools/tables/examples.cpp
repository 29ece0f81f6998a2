#include "tools/tables/examples.h"

#include <algorithm>

#include "model/training/samples.h"

namespace prospect::tools {

std::vector<Example> ExamplesOf(const model::Trial& trial, int every, bool paper_tail) {
  const std::vector<model::SegmentSpan> spans = model::SegmentSpans(trial);
  const int last = static_cast<int>(spans.size()) - 1;
  std::vector<Example> examples;
  int during = 0;  // frames during actions so far
  for (int frame = 0; frame < trial.frames(); ++frame) {
    const int segment = trial.segment[static_cast<std::size_t>(frame)];
    if (segment < 0 || during++ % every != 0) continue;
    if (segment == last && !paper_tail) continue;
    const auto& now = spans[static_cast<std::size_t>(segment)];
    const auto& next = spans[static_cast<std::size_t>(std::min(segment + 1, last))];
    examples.push_back({frame, trial.actions[static_cast<std::size_t>(frame)], now.goal,
                        trial.actions[static_cast<std::size_t>(next.first)], next.goal});
  }
  return examples;
}

}  // namespace prospect::tools

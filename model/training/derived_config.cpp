#include "model/training/derived_config.h"

#include <algorithm>

namespace prospect::model {
namespace {

constexpr int kBatch = 8;
constexpr std::size_t kUnknownSegments = 2000;
constexpr std::int64_t kFewest = 200, kMost = 40'000;

// So many batches that each action that was recorded is seen `times` times.
std::int64_t Iterations(std::size_t segments, double times) {
  const double batches = times * static_cast<double>(segments) / kBatch;
  return std::clamp(static_cast<std::int64_t>(batches), kFewest, kMost);
}

}  // namespace

TrainConfig DerivedConfig(const TrainingSize& size) {
  const std::size_t segments = size.segments > 0 ? size.segments : kUnknownSegments;
  TrainConfig c;
  c.network.image_width = size.image_width;
  c.network.image_height = size.image_height;
  c.network.num_actions = size.num_actions;
  // Few pictures are learned by heart; many need no dropout (tasks/stacking.yaml).
  c.network.dropout = segments < 5000 ? 0.05 : 0.0;
  c.network.head_dropout = 0.2;
  c.network.transform_mask = true;
  c.shards = size.image_width * size.image_height > 64 * 64 ? 1 : 2;
  c.mids_per_segment = 1;
  c.focus = 5.0;
  c.landmark_weight = 2.0;  // where the data have landmarks
  c.classifier = {Iterations(segments, 8), kBatch, 1e-3};
  c.encoder_decoder = {Iterations(segments, 12), kBatch, 2e-3};
  c.transform_hidden = {Iterations(segments, 30), kBatch, 2e-3};
  c.transform_image = {Iterations(segments, 4), kBatch, 5e-4};
  c.heads = {Iterations(segments, 12), kBatch, 1e-3};
  c.heads_need_failures = true;
  c.linked_steps = std::clamp(size.plan_length, 1, 3);
  c.repeat_last = false;
  c.start_share = 0.8;  // the planner always looks between actions
  c.done_weight = 0.2;
  Validate(c);
  return c;
}

}  // namespace prospect::model

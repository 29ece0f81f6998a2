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
  c.network.dropout = 0.0;  // it slows learning (tasks/stacking.yaml), and time is what is short
  c.network.head_dropout = 0.2;
  c.network.transform_mask = true;
  c.network.transform_action = "scale_and_shift";
  c.precision = "float32";  // with batches as small as these 16-bit numbers save no time
  c.shards = size.image_width * size.image_height > 64 * 64 ? 1 : 2;
  c.mids_per_segment = 0;  // what is seen inside an action no plan is made from
  c.focus = 5.0;
  c.landmark_weight = 2.0;  // where the data have landmarks
  // C reads which action a picture is the goal of: for comparisons, not for planning.
  c.classifier.iterations = 0;
  c.lambda = 0;
  // Most for T on encodings, where f is learned with it: whether an action succeeds decides plans.
  c.encoder_decoder = {Iterations(segments, 6), kBatch, 2e-3};
  c.transform_hidden = {Iterations(segments, 40), kBatch, 2e-3};
  c.transform_image = {Iterations(segments, 0.6), kBatch, 5e-4};
  // V, Q and f learn last, on what T imagines by then; with a quarter of this, plans that fail look
  // as good as others.
  c.heads = {Iterations(segments, 24), kBatch, 1e-3};
  c.heads_need_failures = true;
  c.linked_steps = std::clamp(size.plan_length, 1, 2);
  c.repeat_last = false;
  c.start_share = 1;    // the planner always looks between actions
  c.done_weight = 0.5;  // whether an action succeeds counts more than how it looks
  Validate(c);
  return c;
}

}  // namespace prospect::model

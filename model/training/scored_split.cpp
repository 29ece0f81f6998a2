#include "model/training/scored_split.h"

#include "model/training/parallel.h"

namespace prospect::model {

ScoredSplit::ScoredSplit(const TrainContext& context, Split split, std::size_t most_trials,
                         int threads)
    : context_(context) {
  const std::vector<int> all = context.samples.TrialsOf(split);
  if (all.empty()) {
    throw DataError(std::string("the ") + SplitName(split) +
                    " part has no trials to score; collect more trials");
  }
  const std::size_t step = (all.size() + most_trials - 1) / most_trials;
  for (std::size_t i = 0; i < all.size(); i += step) trials_.push_back(all[i]);
  std::vector<int> slots;
  const auto add = [&](int slot) {
    if (row_of_slot_.emplace(slot, static_cast<int64_t>(slots.size())).second)
      slots.push_back(slot);
  };
  for (const int t : trials_) {
    const TrialSample& trial = context.trial(t);
    add(trial.first);
    for (int s = trial.first_segment; s < trial.first_segment + trial.segments; ++s) {
      add(context.segment(s).start);
      add(context.segment(s).goal);
      for (const int mid : context.segment(s).mids) add(mid);
    }
  }
  const NetworkConfig& c = context.config.network;
  hidden_ = torch::empty(
      {static_cast<int64_t>(slots.size()), c.hidden_channels, c.hidden_height(), c.hidden_width()},
      torch::TensorOptions().device(context.device));
  Encoder encoder = context.networks.encoder;
  ParallelPieces(static_cast<int64_t>(slots.size()), 16, context.device.is_cpu() ? threads : 1,
                 [&](int64_t begin, int64_t end) {
                   const torch::NoGradGuard no_grad;
                   const std::vector<int> piece(slots.begin() + begin, slots.begin() + end);
                   hidden_.slice(0, begin, end)
                       .copy_(encoder->forward(context.pictures.Get(piece).to(context.device)));
                 });
}

torch::Tensor ScoredSplit::Hidden(int slot) const {
  const int64_t row = row_of_slot_.at(slot);
  return hidden_.slice(0, row, row + 1);
}

}  // namespace prospect::model

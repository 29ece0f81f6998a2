#include "model/training/batches.h"

#include <algorithm>

#include "base/hash.h"

namespace prospect::model {

int ShardSize(int batch, int shard, int shards) {
  return std::max(1, batch * (shard + 1) / shards - batch * shard / shards);
}

CounterRandom BatchRandom(const TrainConfig& config, const std::string& stage,
                          std::int64_t iteration, int shard) {
  return CounterRandom(config.seed, base::HashText(stage + "/batch"),
                       static_cast<std::uint64_t>(iteration * 64 + shard));
}

Chain MakeChain(const TrainContext& context, int segment, int start, int steps, bool repeat_last) {
  const TrialSample& trial = context.trial(context.segment(segment).trial);
  const int end = trial.first_segment + trial.segments;
  Chain chain{trial.first, start, {}, {}};
  for (int k = 0; k < steps; ++k) {
    const bool exists = segment + k < end;
    chain.segments.push_back(exists ? segment + k : end - 1);
    chain.weights.push_back(exists || repeat_last ? 1.0F : 0.0F);
  }
  return chain;
}

ChainBatch::ChainBatch(const TrainContext& context, std::vector<Chain> chains,
                       std::vector<int> variants)
    : context_(context), chains_(std::move(chains)), variants_(std::move(variants)) {}

const SegmentSample& ChainBatch::segment(std::size_t row, int step) const {
  return context_.segment(chains_[row].segments[static_cast<std::size_t>(step)]);
}

std::vector<int> ChainBatch::FirstSlots() const {
  std::vector<int> slots;
  for (const Chain& chain : chains_) slots.push_back(chain.first);
  return slots;
}

torch::Tensor ChainBatch::First() const {
  return context_.hidden->Get(FirstSlots(), variants_).to(context_.device);
}

std::vector<int> ChainBatch::StartSlots() const {
  std::vector<int> slots;
  for (const Chain& chain : chains_) slots.push_back(chain.start);
  return slots;
}

torch::Tensor ChainBatch::Start() const {
  return context_.hidden->Get(StartSlots(), variants_).to(context_.device);
}

std::vector<int> ChainBatch::Views() const {
  std::vector<int> views;
  for (std::size_t i = 0; i < size(); ++i) {
    views.push_back(context_.ViewOf(segment(i, 0).trial, variants_[i]));
  }
  return views;
}

std::vector<int> ChainBatch::GoalSlots(int step) const {
  std::vector<int> slots;
  for (std::size_t i = 0; i < size(); ++i) slots.push_back(segment(i, step).goal);
  return slots;
}

torch::Tensor ChainBatch::Goal(int step) const {
  return context_.hidden->Get(GoalSlots(step), variants_).to(context_.device);
}

torch::Tensor ChainBatch::Actions(int step) const {
  std::vector<int> actions;
  for (std::size_t i = 0; i < size(); ++i) actions.push_back(segment(i, step).action);
  return ActionTensor(actions, context_.device);
}

torch::Tensor ChainBatch::Weights(int step) const {
  std::vector<float> weights;
  for (const Chain& chain : chains_)
    weights.push_back(chain.weights[static_cast<std::size_t>(step)]);
  return FloatTensor(weights, context_.device);
}

torch::Tensor ChainBatch::Succeeded(int step) const {
  std::vector<float> labels;
  for (std::size_t i = 0; i < size(); ++i)
    labels.push_back(segment(i, step).succeeded ? 1.0F : 0.0F);
  return FloatTensor(labels, context_.device);
}

}  // namespace prospect::model

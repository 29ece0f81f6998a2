#pragma once

#include <string>
#include <vector>

#include "model/training/context.h"
#include "model/training/random.h"

namespace prospect::model {

/// How many of `batch` samples shard `shard` of `shards` computes (at least one).
int ShardSize(int batch, int shard, int shards);

/// The random numbers of one shard of one batch.
CounterRandom BatchRandom(const TrainConfig& config, const std::string& stage,
                          std::int64_t iteration, int shard);

/// Rows of consecutive actions of one trial, as T is trained on: from slot `start`, step k carries
/// out actions[k], whose goal picture is goals[k].
struct Chain {
  int first = 0;               ///< slot of x0
  int start = 0;               ///< slot of the state it begins from
  std::vector<int> segments;   ///< index of the segment of each step; repeated at a trial's end
  std::vector<float> weights;  ///< per step 1, or 0 where the trial has no such step
};

/// The chain of `steps` steps that begins at segment `segment` from slot `start`. Steps past the
/// trial's last segment repeat it, with weight 1 if `repeat_last`, else 0.
Chain MakeChain(const TrainContext& context, int segment, int start, int steps, bool repeat_last);

/// A batch of chains as columns.
class ChainBatch {
 public:
  ChainBatch(const TrainContext& context, std::vector<Chain> chains, std::vector<int> variants);

  std::size_t size() const { return chains_.size(); }
  int steps() const { return static_cast<int>(chains_.front().segments.size()); }
  torch::Tensor First() const;              ///< encodings of x0 [B,...], on the device
  torch::Tensor Start() const;              ///< encodings of the states they begin from
  torch::Tensor Goal(int step) const;       ///< encodings of the goal pictures
  torch::Tensor Actions(int step) const;    ///< [B] int64
  torch::Tensor Weights(int step) const;    ///< [B]
  torch::Tensor Succeeded(int step) const;  ///< [B], f's label
  std::vector<int> Views() const;           ///< how each row's pictures are varied
  std::vector<int> FirstSlots() const;      ///< slots of x0
  std::vector<int> StartSlots() const;      ///< slots of the states they begin from
  /// Slots of the goal pictures.
  std::vector<int> GoalSlots(int step) const;

 private:
  const SegmentSample& segment(std::size_t row, int step) const;

  const TrainContext& context_;
  std::vector<Chain> chains_;
  std::vector<int> variants_;
};

}  // namespace prospect::model

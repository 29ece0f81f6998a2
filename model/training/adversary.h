#pragma once

#include <torch/torch.h>

#include "model/networks/discriminator.h"
#include "model/training/random.h"
#include "model/training/train_config.h"

namespace prospect::model {

/// The pictures that a judge compares: two in a row and the action before the second.
struct JudgedPair {
  torch::Tensor x1, x2;  ///< [B,3,H,W]
  torch::Tensor action;  ///< [B] int64
};

/// The adversarial part of T's loss (TrainConfig::adversary): a judge that learns to tell imagined
/// pictures from real ones, and what T loses when it is found out. Both are summed into one loss:
/// the judge's part does not reach T, and T's does not reach the judge's weights.
class Adversary {
 public:
  explicit Adversary(const TrainConfig& config);

  Discriminator& judge() { return judge_; }

  /// Whether T learns in this iteration; the judge always does. "wgan": after every
  /// `judge_steps` iterations of the judge alone (Arjovsky et al. 2017); "pix2pix": always.
  bool GeneratorsTurn(std::int64_t iteration) const;

  /// What the judge loses: imagined pictures it takes for real ones and real ones it does not.
  /// pix2pix: binary cross-entropy with noisy targets, as the authors'; wgan: the difference of the
  /// mean scores.
  torch::Tensor JudgesLoss(const JudgedPair& real, const JudgedPair& imagined,
                           CounterRandom* random);

  /// What T loses when its pictures are found out.
  torch::Tensor GeneratorsLoss(const JudgedPair& imagined);

  /// After a step of the optimizer: "wgan" cuts the judge's weights to +-clip.
  void AfterStep();

 private:
  bool wgan_;
  int judge_steps_;
  double clip_;
  Discriminator judge_;
};

}  // namespace prospect::model

#include "model/training/adversary.h"

namespace prospect::model {
namespace {

using Learns = DiscriminatorImpl::Learns;

constexpr float kLabelNoise = 0.1F;  // targets are this near to 0 or 1 (authors' code)

/// Targets [like] of 0 (real) or 1 (imagined), each up to kLabelNoise off.
torch::Tensor NoisyTargets(const torch::Tensor& like, bool imagined, CounterRandom* random) {
  std::vector<float> values;
  for (std::int64_t i = 0; i < like.size(0); ++i) {
    const float off = kLabelNoise * static_cast<float>(random->Uniform());
    values.push_back(imagined ? 1 - off : off);
  }
  return torch::tensor(values).to(like.device());
}

}  // namespace

Adversary::Adversary(const TrainConfig& config)
    : wgan_(config.adversary == "wgan"),
      judge_steps_(config.judge_steps),
      clip_(config.judge_clip),
      judge_(config.network, !wgan_) {}

bool Adversary::GeneratorsTurn(std::int64_t iteration) const {
  return !wgan_ || iteration % (judge_steps_ + 1) == judge_steps_;
}

torch::Tensor Adversary::JudgesLoss(const JudgedPair& real, const JudgedPair& imagined,
                                    CounterRandom* random) {
  const torch::Tensor of_real = judge_->forward(real.x1, real.x2, real.action, Learns::kYes);
  const torch::Tensor of_imagined =
      judge_->forward(imagined.x1.detach(), imagined.x2.detach(), imagined.action, Learns::kYes);
  if (wgan_) return of_imagined.mean() - of_real.mean();
  return torch::binary_cross_entropy(of_real, NoisyTargets(of_real, false, random)) +
         torch::binary_cross_entropy(of_imagined, NoisyTargets(of_imagined, true, random));
}

torch::Tensor Adversary::GeneratorsLoss(const JudgedPair& imagined) {
  const torch::Tensor verdict =
      judge_->forward(imagined.x1, imagined.x2, imagined.action, Learns::kNo);
  if (wgan_) return -verdict.mean();
  return torch::binary_cross_entropy(verdict, torch::zeros_like(verdict));
}

void Adversary::AfterStep() {
  if (wgan_) judge_->Clip(clip_);
}

}  // namespace prospect::model

#include "model/networks/precision.h"

namespace prospect::model {
namespace {
thread_local bool mixed = false;
}

MixedPrecision::MixedPrecision(bool on) : before_(mixed) { mixed = mixed || on; }
MixedPrecision::~MixedPrecision() { mixed = before_; }

torch::Tensor Convolve(torch::nn::Conv2d& conv, const torch::Tensor& x, int64_t padding,
                       bool may_round) {
  if (!mixed || !may_round) return conv->forward(x);
  return torch::conv2d(x.to(torch::kBFloat16), conv->weight.to(torch::kBFloat16),
                       conv->bias.to(torch::kBFloat16), conv->options.stride(), padding)
      .to(torch::kFloat);
}

}  // namespace prospect::model

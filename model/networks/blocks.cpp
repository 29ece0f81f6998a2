#include "model/networks/blocks.h"

#include <ATen/CPUGeneratorImpl.h>

#include <stdexcept>

#include "model/networks/precision.h"

namespace prospect::model {
namespace {

constexpr double kLeakySlope = 0.2;
constexpr double kNormEpsilon = 1e-5;  // keeps a channel without contrast finite

torch::nn::Conv2d MakeConv(int in, int out, int kernel, int stride, int padding) {
  return torch::nn::Conv2d(
      torch::nn::Conv2dOptions(in, out, kernel).stride(stride).padding(padding));
}

torch::Tensor Modulate(const torch::Tensor& x, const torch::Tensor& modulation) {
  const std::vector<torch::Tensor> halves = modulation.unsqueeze(2).unsqueeze(3).chunk(2, 1);
  return x * (1 + halves[0]) + halves[1];
}

torch::Tensor Finish(torch::Tensor x, InstanceNorm& norm, const torch::Tensor& modulation,
                     const BlockOptions& options, bool training) {
  if (options.norm) x = norm->forward(x);
  if (modulation.defined()) x = Modulate(x, modulation);
  // In its own place: nobody else has it, and maps are large.
  x = options.activation == Activation::kRelu ? torch::relu_(x) : Activate(x, options.activation);
  return Dropout(x, options.dropout, training);
}

at::Generator& ThreadGenerator() {
  thread_local at::Generator generator = at::detail::createCPUGenerator(0);
  return generator;
}

}  // namespace

torch::Tensor Dropout(const torch::Tensor& x, double rate, bool training) {
  if (!training || rate <= 0.0) return x;
  if (!x.device().is_cpu()) return torch::dropout(x, rate, true);
  const torch::Tensor mask = torch::empty_like(x, x.options().requires_grad(false))
                                 .bernoulli_(1.0 - rate, ThreadGenerator());
  return x * mask.div_(1.0 - rate);
}

void SeedDropout(uint64_t seed) { ThreadGenerator().set_current_seed(seed); }

Activation ActivationOf(const std::string& name) {
  if (name == "relu") return Activation::kRelu;
  if (name == "leaky_relu") return Activation::kLeakyRelu;
  throw std::invalid_argument("activation '" + name + "': must be relu or leaky_relu");
}

torch::Tensor Activate(const torch::Tensor& x, Activation activation) {
  switch (activation) {
    case Activation::kRelu:
      return torch::relu(x);
    case Activation::kLeakyRelu:
      return torch::leaky_relu(x, kLeakySlope);
    case Activation::kSigmoid:
      return torch::sigmoid(x);
    case Activation::kNone:
      break;
  }
  return x;
}

InstanceNormImpl::InstanceNormImpl(int channels) {
  scale_ = register_parameter("scale", torch::ones({channels}));
  shift_ = register_parameter("shift", torch::zeros({channels}));
}

torch::Tensor InstanceNormImpl::forward(const torch::Tensor& x) {
  return torch::group_norm(x, scale_.size(0), scale_, shift_, kNormEpsilon);
}

VectorNormImpl::VectorNormImpl() {
  scale_ = register_parameter("scale", torch::ones({1}));
  shift_ = register_parameter("shift", torch::zeros({1}));
}

torch::Tensor VectorNormImpl::forward(const torch::Tensor& x) {
  return torch::layer_norm(x, {x.size(1)}, {}, {}, kNormEpsilon) * scale_ + shift_;
}

ConvBlockImpl::ConvBlockImpl(int in, int out, int kernel, int stride, const BlockOptions& options)
    : options_(options),
      uneven_(kernel % 2 == 0 && stride == 1),
      padding_(uneven_ ? 0 : (kernel - 1) / 2) {
  conv_ = register_module("conv", MakeConv(in, out, kernel, stride, padding_));
  if (options_.norm) norm_ = register_module("norm", InstanceNorm(out));
}

torch::Tensor ConvBlockImpl::forward(const torch::Tensor& x) { return Modulated(x, {}); }

torch::Tensor ConvBlockImpl::Modulated(const torch::Tensor& x, const torch::Tensor& modulation) {
  const auto finish = [&](const torch::Tensor& padded) {
    return Finish(Convolve(conv_, padded, padding_, options_.norm), norm_, modulation, options_,
                  is_training());
  };
  if (!uneven_) return finish(x);
  const int64_t before = (conv_->options.kernel_size()->at(0) - 1) / 2;
  const int64_t after = conv_->options.kernel_size()->at(0) - 1 - before;
  return finish(torch::constant_pad_nd(x, {before, after, before, after}));
}

UpBlockImpl::UpBlockImpl(int in, int out, const BlockOptions& options) : options_(options) {
  conv_ = register_module("conv", MakeConv(in, 4 * out, 3, 1, 1));
  if (options_.norm) norm_ = register_module("norm", InstanceNorm(out));
}

torch::Tensor UpBlockImpl::forward(const torch::Tensor& x) { return Modulated(x, {}); }

torch::Tensor UpBlockImpl::Modulated(const torch::Tensor& x, const torch::Tensor& modulation) {
  return Finish(torch::pixel_shuffle(Convolve(conv_, x, 1, options_.norm), 2), norm_, modulation,
                options_, is_training());
}

torch::Tensor SpatialSoftArgmax(const torch::Tensor& x) {
  const int64_t height = x.size(2);
  const int64_t width = x.size(3);
  const torch::Tensor weights = torch::softmax(x.flatten(2), 2).view_as(x);
  const torch::Tensor rows = torch::linspace(-1, 1, height, x.options());
  const torch::Tensor columns = torch::linspace(-1, 1, width, x.options());
  const torch::Tensor row = (weights.sum(3) * rows).sum(2);
  const torch::Tensor column = (weights.sum(2) * columns).sum(2);
  return torch::stack({row, column}, 2).flatten(1);
}

torch::Tensor OneHot(const torch::Tensor& actions, int n) {
  return torch::one_hot(actions, n + 1).narrow(1, 0, n).to(torch::kFloat);
}

torch::Tensor Tile(const torch::Tensor& v, int64_t height, int64_t width) {
  return v.unsqueeze(2).unsqueeze(3).expand({v.size(0), v.size(1), height, width});
}

void InitialiseGlorot(torch::nn::Module* module) {
  const torch::NoGradGuard no_grad;
  for (const auto& child : module->modules(/*include_self=*/false)) {
    if (auto* conv = child->as<torch::nn::Conv2d>()) {
      torch::nn::init::xavier_uniform_(conv->weight);
      torch::nn::init::zeros_(conv->bias);
    } else if (auto* dense = child->as<torch::nn::Linear>()) {
      torch::nn::init::xavier_uniform_(dense->weight);
      torch::nn::init::zeros_(dense->bias);
    }
  }
}

}  // namespace prospect::model

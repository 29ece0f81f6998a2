#pragma once

#include <string>

#include "model/networks/libtorch.h"

/// The layers that all image networks are made of (paper §III-A; order and slope from the authors'
/// code). Modules follow libtorch's rules: a holder shares its module; one thread may train a
/// module at a time, several may run it for inference.
namespace prospect::model {

enum class Activation { kNone, kRelu, kLeakyRelu, kSigmoid };

/// "relu" or "leaky_relu" (slope 0.2); anything else throws std::invalid_argument.
Activation ActivationOf(const std::string& name);
torch::Tensor Activate(const torch::Tensor& x, Activation activation);

/// What follows a convolution in a block.
struct BlockOptions {
  Activation activation = Activation::kRelu;
  bool norm = true;
  double dropout = 0.0;
};

/// Instance normalisation: every channel of every picture to mean 0 and variance 1 over its pixels,
/// then a learned scale and shift a channel (Ulyanov et al. 2016). Computed as a group
/// normalisation with one channel a group, which is the same function and runs faster on CPUs.
class InstanceNormImpl : public torch::nn::Module {
 public:
  explicit InstanceNormImpl(int channels);
  torch::Tensor forward(const torch::Tensor& x);  ///< [B,C,H,W] to the same

 private:
  torch::Tensor scale_, shift_;
};
TORCH_MODULE(InstanceNorm);

/// Normalisation of a dense layer: over the whole vector, one scalar scale and shift (authors'
/// code).
class VectorNormImpl : public torch::nn::Module {
 public:
  VectorNormImpl();
  torch::Tensor forward(const torch::Tensor& x);  ///< [B,N] to the same

 private:
  torch::Tensor scale_, shift_;
};
TORCH_MODULE(VectorNorm);

/// Convolution, instance norm, activation, dropout. Output size is input size / stride for odd and
/// even kernels ("same" padding; even kernels pad one more at bottom and right).
class ConvBlockImpl : public torch::nn::Module {
 public:
  ConvBlockImpl(int in, int out, int kernel, int stride, const BlockOptions& options);
  torch::Tensor forward(const torch::Tensor& x);  ///< [B,in,H,W] to [B,out,H/stride,W/stride]
  /// The same, its channels scaled by 1 + the first half of `modulation` [B,2*out] and shifted by
  /// the second after the norm (Perez et al. 2018); forward(x) where that is undefined.
  torch::Tensor Modulated(const torch::Tensor& x, const torch::Tensor& modulation);

 private:
  BlockOptions options_;
  bool uneven_ = false;  ///< even kernel at stride 1: pad by hand
  int padding_ = 0;      ///< of the convolution itself
  torch::nn::Conv2d conv_{nullptr};
  InstanceNorm norm_{nullptr};
};
TORCH_MODULE(ConvBlock);

/// Doubles height and width: the paper's 5x5 transposed convolution of stride 2, written as a 3x3
/// convolution to four times the channels and a pixel shuffle. Both compute each output pixel from
/// a 3x3 (or smaller) neighbourhood of input pixels with one kernel for each of the four output
/// phases, so this one can express every function the other can; it is 2.5 times faster in
/// libtorch 1.13 on CPUs.
class UpBlockImpl : public torch::nn::Module {
 public:
  UpBlockImpl(int in, int out, const BlockOptions& options);
  torch::Tensor forward(const torch::Tensor& x);  ///< [B,in,H,W] to [B,out,2H,2W]
  torch::Tensor Modulated(const torch::Tensor& x, const torch::Tensor& modulation);

 private:
  BlockOptions options_;
  torch::nn::Conv2d conv_{nullptr};
  InstanceNorm norm_{nullptr};
};
TORCH_MODULE(UpBlock);

/// Expected position of each channel's softmax over the grid (Levine et al. 2016; temperature 1):
/// [B,C,H,W] to [B,2C], channel's row then column, each from -1 to 1.
torch::Tensor SpatialSoftArgmax(const torch::Tensor& x);

/// Action indices [B] (0..n-1; n = none gives a zero row) to one-hot rows [B,n] of the device's
/// float type.
torch::Tensor OneHot(const torch::Tensor& actions, int n);

/// A vector [B,N] repeated over a grid: [B,N,height,width].
torch::Tensor Tile(const torch::Tensor& v, int64_t height, int64_t width);

/// Dropout: with probability `rate` a value becomes 0, the others are scaled by 1/(1-rate); nothing
/// when not `training`. On CPUs the draws come from this thread's own generator (SeedDropout), so
/// that several threads can train on one module and give the same numbers every time; elsewhere
/// from the device's.
torch::Tensor Dropout(const torch::Tensor& x, double rate, bool training);

/// Seeds the calling thread's generator of Dropout.
void SeedDropout(uint64_t seed);

/// Glorot-uniform weights and zero biases for every convolution and dense layer (the authors'
/// defaults).
void InitialiseGlorot(torch::nn::Module* module);

}  // namespace prospect::model

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/inference/arena.h"
#include "model/inference/convolution.h"
#include "model/inference/kernels.h"
#include "model/inference/packed_matrix.h"
#include "model/weights_file.h"

/// The layers that all networks are made of, with their weights (model/networks/blocks.h says what
/// each computes). Immutable; several threads may run one, each with an arena of its own. What is
/// run for several maps or rows is run for each alone, bit for bit.
namespace prospect::model::inference {

/// Takes tensors out of a weights file by name. Throws WeightsError naming the file.
class TensorReader {
 public:
  TensorReader(const WeightsFile& file, const std::string& path) : file_(file), path_(path) {}
  std::vector<float> Read(const std::string& name, const std::vector<std::int64_t>& shape) const {
    return NetworkTensor(file_, path_, name, shape);
  }
  ConvolutionWeights ReadConvolution(const std::string& name, int in, int out, int kernel) const {
    return {out, in, kernel, Read(name + ".weight", {out, in, kernel, kernel})};
  }

 private:
  const WeightsFile& file_;
  const std::string& path_;
};

/// Scale and shift of an instance norm, and the activation behind it.
struct Norm {
  std::vector<float> scale, shift;
  Activation activation = Activation::kRelu;

  /// In place; `added` and `modulation` (2 x channels numbers) may be null.
  void Run(const Kernels& kernels, float* map, Grid grid, const AddedMap& added,
           const float* modulation) const;
};

/// The tensors of one block of a network: "name.conv", and "name.norm" where one follows.
struct BlockTensors {
  ConvolutionWeights convolution;
  std::vector<float> bias;  ///< a norm takes it away again, but where the block doubles
  Norm norm;
};
BlockTensors ReadNormedBlock(const TensorReader& reader, const std::string& name, int in, int out,
                             int kernel, Activation activation);
BlockTensors ReadBiasedBlock(const TensorReader& reader, const std::string& name, int in, int out,
                             int kernel);
/// A block that doubles: 3 x 3 to four times `out` channels, which the norm sees shuffled.
BlockTensors ReadDoublingBlock(const TensorReader& reader, const std::string& name, int in,
                               int out);

/// Convolution, instance norm, activation.
class NormedBlock {
 public:
  NormedBlock(const Kernels& kernels, Grid in, int stride, BlockTensors tensors);
  struct Doubling {};
  NormedBlock(const Kernels& kernels, Grid in, BlockTensors tensors, Doubling);

  void Run(const float* in, int maps, float* out, Arena& arena) const;
  /// The two halves of Run, for what comes between them; the second is of one map. Nothing is added
  /// where the block doubles.
  void Convolve(const float* in, int maps, float* out, Arena& arena) const;
  void Normalise(float* map, const AddedMap& added, const float* modulation) const;

  const Convolution& convolution() const { return *convolution_; }

 private:
  const Kernels& kernels_;
  std::unique_ptr<Convolution> convolution_;
  Norm norm_;
  // Of a block that doubles: rows of biases, and which of them a pixel gets.
  std::vector<float> phase_bias_;
  std::vector<std::int32_t> phase_of_pixel_;
};

/// Convolution, bias, activation.
class BiasedBlock {
 public:
  BiasedBlock(const Kernels& kernels, Grid in, int stride, const BlockTensors& tensors,
              Activation activation);

  void Run(const float* in, int maps, float* out, Arena& arena) const;
  const Convolution& convolution() const { return *convolution_; }

 private:
  const Kernels& kernels_;
  std::unique_ptr<Convolution> convolution_;
  std::vector<float> bias_;  // a whole map of it
  Activation activation_;
};

/// A vector repeated `times` times.
std::vector<float> Repeated(const std::vector<float>& values, int times);

/// y = x W + b.
class Dense {
 public:
  /// @param weights [in][out]; @param bias [out]
  Dense(const Kernels& kernels, int in, const std::vector<float>& weights, std::vector<float> bias);
  /// The tensors "name.weight" and "name.bias", for inputs that are a map.
  Dense(const Kernels& kernels, const TensorReader& reader, const std::string& name, int channels,
        int pixels, int out);

  /// `rows` vectors of inputs() numbers to as many of outputs().
  void Run(const float* in, int rows, float* out, Activation activation, Arena& arena) const;
  int inputs() const { return weights_.inputs(); }
  int outputs() const { return weights_.outputs(); }

 private:
  const Kernels& kernels_;
  PackedMatrix weights_;
  std::vector<float> bias_;
};

/// libtorch's [out][in] to [in][out], where the inputs are a map of `channels` that libtorch has
/// channel by channel and we pixel by pixel; plain vectors are maps of one pixel.
std::vector<float> InputMajor(const std::vector<float>& weights, int out, int channels, int pixels);

/// Channel by channel to pixel by pixel, and back.
void ToPixelMajor(const float* from, int channels, int pixels, float* to);
void ToChannelMajor(const float* from, int channels, int pixels, float* to);

}  // namespace prospect::model::inference

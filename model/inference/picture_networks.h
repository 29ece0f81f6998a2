#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/inference/layers.h"
#include "model/network_config.h"

/// The networks that read and paint pictures (model/networks/{encoder,decoder,classifier}.h).
/// Immutable; an arena a thread.
namespace prospect::model::inference {

/// height x width x 3 bytes to numbers from 0 to 1.
void ToFloats(const std::uint8_t* rgb, std::size_t count, float* to);

class Encoder {
 public:
  Encoder(const Kernels& kernels, const TensorReader& reader, const NetworkConfig& config);
  /// A picture, height x width x 3 numbers from 0 to 1, to its hidden state, pixel by pixel.
  void Run(const float* picture, float* h, Arena& arena) const;

 private:
  const Kernels& kernels_;
  std::vector<NormedBlock> blocks_;
  std::optional<BiasedBlock> out_;
};

class Decoder {
 public:
  Decoder(const Kernels& kernels, const TensorReader& reader, const NetworkConfig& config);
  /// A hidden state, pixel by pixel, to a picture, height x width x 3 numbers from 0 to 1.
  void Run(const float* h, float* picture, Arena& arena) const;

 private:
  const Kernels& kernels_;
  std::vector<NormedBlock> blocks_;
  std::optional<BiasedBlock> out_;
};

class Classifier {
 public:
  Classifier(const Kernels& kernels, const TensorReader& reader, const std::string& name,
             const NetworkConfig& config);
  /// Probabilities of the actions.
  std::vector<float> Run(const float* picture, Arena& arena) const;

 private:
  std::vector<NormedBlock> blocks_;
  std::optional<Dense> dense_, out_;
};

}  // namespace prospect::model::inference

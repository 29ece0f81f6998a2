#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "model/networks/libtorch.h"
#include "model/weights_file.h"

/// Weights files (model/weights_file.h) to and from libtorch's modules. Functions are thread-safe.
namespace prospect::model {

/// A tensor as stored, 16-bit or 32-bit floats, on the CPU.
torch::Tensor ToTorch(const StoredTensor& stored);

/// Any float tensor as 32-bit floats.
StoredTensor ToStored(const torch::Tensor& tensor);

/// WriteWeights of torch tensors.
void WriteWeights(const std::string& path, const std::map<std::string, torch::Tensor>& tensors,
                  const nlohmann::json& metadata);

/// Tensors of a module by "prefix.name", detached.
void CollectTensors(const std::string& prefix, const torch::nn::Module& module,
                    std::map<std::string, torch::Tensor>* tensors);

/// Copies the tensors "prefix.*" into `module` (any float type on any device). Throws WeightsError
/// naming `path` if one is missing, has another shape, or is not a number.
void LoadModule(const WeightsFile& file, const std::string& path, const std::string& prefix,
                torch::nn::Module* module);
/// The same from a file on disk.
void LoadModule(const std::string& path, const std::string& prefix, torch::nn::Module* module);

}  // namespace prospect::model

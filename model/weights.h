#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "model/networks/libtorch.h"
#include "model/networks/networks.h"
#include "model/weights_error.h"

/// Weights files: the safetensors format (8 bytes little-endian header length, a JSON header that
/// names each tensor's type, shape and place, the data), tensors stored as 16-bit floats. Metadata
/// is one text entry "prospect", a JSON object: format, task, task_hash, world_version, network
/// (NetworkConfig), train (TrainConfig), data_hash, code_version, scores, calibration. Functions
/// are thread-safe.
namespace prospect::model {

/// A weights file in memory: tensors by name (as stored, 16-bit or 32-bit floats, on the CPU).
struct WeightsFile {
  std::map<std::string, torch::Tensor> tensors;
  nlohmann::json metadata;  ///< the object described above
  std::uint64_t hash = 0;   ///< FNV-1a of all bytes of the file
};

/// Reads and checks a file: names that come once, sizes, types, places without gaps or overlaps, a
/// header of at most 16 MB. Throws WeightsError.
WeightsFile ReadWeights(const std::string& path);

/// Writes tensors as 16-bit floats, whole or not at all. Throws base::DiskError if it cannot,
/// WeightsError if a value does not fit 16 bits.
void WriteWeights(const std::string& path, const std::map<std::string, torch::Tensor>& tensors,
                  const nlohmann::json& metadata);

/// Hash of all bytes of a file. Throws WeightsError.
std::uint64_t WeightsFileHash(const std::string& path);

/// Tensors of a module by "prefix.name", detached.
void CollectTensors(const std::string& prefix, const torch::nn::Module& module,
                    std::map<std::string, torch::Tensor>* tensors);

/// Copies the tensors "prefix.*" into `module` (any float type on any device). Throws WeightsError
/// naming `path` if one is missing, has another shape, or is not a number.
void LoadModule(const WeightsFile& file, const std::string& path, const std::string& prefix,
                torch::nn::Module* module);
/// The same from a file on disk.
void LoadModule(const std::string& path, const std::string& prefix, torch::nn::Module* module);

/// True if the file holds any tensor "prefix.*".
bool HasModule(const WeightsFile& file, const std::string& prefix);

}  // namespace prospect::model

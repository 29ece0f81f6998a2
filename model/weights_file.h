#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/network_config.h"
#include "model/weights_error.h"

/// Weights files: the safetensors format (8 bytes little-endian header length, a JSON header that
/// names each tensor's type, shape and place, the data), tensors stored as 16-bit floats. Metadata
/// is one text entry "prospect", a JSON object: format, task, task_hash, world_version, network
/// (NetworkConfig), train (TrainConfig), data_hash, code_version, scores, calibration. No libtorch
/// here; model/weights.h makes torch tensors of it. Functions are thread-safe.
namespace prospect::model {

/// A tensor as a file holds it. A plain value.
struct StoredTensor {
  enum class Type { kHalf, kFloat };  ///< IEEE 754, 16 or 32 bits, in the machine's byte order
  Type type = Type::kHalf;
  std::vector<std::int64_t> shape;
  std::string bytes;  ///< the numbers, row major: product of shape times BytesOf(type)
};

std::size_t BytesOf(StoredTensor::Type type);
/// Rounds to the nearest 16-bit float, ties to even; what is too large becomes infinite.
StoredTensor HalfTensor(const std::vector<std::int64_t>& shape, const std::vector<float>& values);
std::vector<float> ToFloats(const StoredTensor& tensor);
/// True if every one is a finite number.
bool AllFinite(const std::vector<float>& values);

/// A weights file in memory.
struct WeightsFile {
  std::map<std::string, StoredTensor> tensors;  ///< by name
  nlohmann::json metadata;                      ///< the object described above
  std::uint64_t hash = 0;                       ///< FNV-1a of all bytes of the file
};

/// Reads and checks a file: names that come once, sizes, types, places without gaps or overlaps, a
/// header of at most 16 MB. Throws WeightsError.
WeightsFile ReadWeights(const std::string& path);

/// Writes tensors as 16-bit floats, whole or not at all. Throws base::DiskError if it cannot,
/// WeightsError if a value does not fit 16 bits.
void WriteWeights(const std::string& path, const std::map<std::string, StoredTensor>& tensors,
                  const nlohmann::json& metadata);

/// Hash of all bytes of a file. Throws WeightsError.
std::uint64_t WeightsFileHash(const std::string& path);

/// True if the file holds any tensor "prefix.*".
bool HasModule(const WeightsFile& file, const std::string& prefix);

/// The numbers of a tensor that a network needs. Throws WeightsError naming `path` if it is
/// missing, has another shape, or holds what is not a number.
std::vector<float> NetworkTensor(const WeightsFile& file, const std::string& path,
                                 const std::string& name, const std::vector<std::int64_t>& shape);

/// The configuration in the metadata. Throws WeightsError naming `path`.
NetworkConfig NetworkConfigOf(const WeightsFile& file, const std::string& path);

}  // namespace prospect::model

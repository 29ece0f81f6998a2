#include "model/weights_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "base/atomic_file.h"
#include "base/hash.h"
#include "base/strict_json.h"
#include "model/half.h"

namespace prospect::model {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestHeader = 16 << 20;
constexpr const char* kMetadataKey = "prospect";

[[noreturn]] void Refuse(const std::string& path, const std::string& reason) {
  throw WeightsError(path + ": " + reason);
}

std::string ReadBytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) Refuse(path, "cannot be opened; is the path right?");
  if (std::filesystem::is_directory(path)) Refuse(path, "is a folder; name the file in it");
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (in.bad()) Refuse(path, "cannot be read");
  return bytes;
}

std::uint64_t HeaderLength(const std::string& path, const std::string& bytes) {
  if (bytes.size() < 8) Refuse(path, "is too short for a weights file; truncated?");
  std::uint64_t length = 0;
  for (int i = 7; i >= 0; --i) {
    length = length << 8 | static_cast<unsigned char>(bytes[static_cast<std::size_t>(i)]);
  }
  if (length > kLongestHeader || length > bytes.size() - 8) {
    Refuse(path, "its header is longer than the file; truncated, or not a safetensors file");
  }
  return length;
}

json ParseHeader(const std::string& path, const std::string& bytes, std::uint64_t length) {
  json header;
  try {
    header = base::ParseStrictJson(std::string_view(bytes).substr(8, length));
  } catch (const base::KeyTwiceError& error) {
    Refuse(path, std::string("its header names ") + (error.path.size() == 1 ? "tensor '" : "'") +
                     error.key + "' twice, and which one counts is chance; damaged");
  }
  if (!header.is_object())
    Refuse(path, "its header is not JSON; damaged, or not a safetensors file");
  return header;
}

StoredTensor::Type TypeOf(const std::string& path, const std::string& name,
                          const std::string& text) {
  if (text == "F16") return StoredTensor::Type::kHalf;
  if (text == "F32") return StoredTensor::Type::kFloat;
  Refuse(path, "tensor '" + name + "' has type " + text + "; F16 and F32 are understood");
}

struct Place {
  std::size_t begin = 0, end = 0;
};

/// One entry of the header, checked against the number of data bytes.
struct Entry {
  StoredTensor::Type type = StoredTensor::Type::kHalf;
  std::vector<std::int64_t> shape;
  Place place;
};

Entry EntryOf(const std::string& path, const std::string& name, const json& item,
              std::size_t data_bytes) {
  Entry entry;
  std::vector<std::size_t> offsets;
  try {
    entry.type = TypeOf(path, name, item.at("dtype").get<std::string>());
    entry.shape = item.at("shape").get<std::vector<std::int64_t>>();
    offsets = item.at("data_offsets").get<std::vector<std::size_t>>();
  } catch (const json::exception&) {
    Refuse(path, "the header's entry of tensor '" + name + "' is damaged");
  }
  std::size_t count = 1;
  for (const std::int64_t extent : entry.shape) {
    if (extent < 0 || extent > (1 << 28)) Refuse(path, "tensor '" + name + "' has a bad shape");
    count *= static_cast<std::size_t>(extent);
    if (count > (std::size_t{1} << 32)) Refuse(path, "tensor '" + name + "' is too large");
  }
  const std::size_t bytes = count * BytesOf(entry.type);
  if (offsets.size() != 2 || offsets[0] > offsets[1] || offsets[1] > data_bytes ||
      offsets[1] - offsets[0] != bytes) {
    Refuse(path, "tensor '" + name + "' does not lie inside the file; truncated?");
  }
  entry.place = {offsets[0], offsets[1]};
  return entry;
}

void RequireNoGaps(const std::string& path, std::vector<Place> places, std::size_t data_bytes) {
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.begin < b.begin || (a.begin == b.begin && a.end < b.end);
  });
  std::size_t at = 0;
  for (const Place& place : places) {
    if (place.begin != at) Refuse(path, "tensors overlap or leave gaps; damaged");
    at = place.end;
  }
  if (at != data_bytes) Refuse(path, "its length does not match its header; truncated?");
}

// Of an entry of the header that the format gives a fixed type.
void RequireType(const std::string& path, bool holds, const std::string& what, const json& found,
                 const char* wanted) {
  if (holds) return;
  Refuse(path, what + " is of type " + found.type_name() + ", where " + wanted +
                   " belongs; damaged, or written by another program");
}

json MetadataOf(const std::string& path, const json& header) {
  const char* no_metadata = "has no metadata of ours; it was not written by ./prospect train";
  const auto found = header.find("__metadata__");
  if (found == header.end()) Refuse(path, no_metadata);
  RequireType(path, found->is_object(), "its '__metadata__'", *found, "an object of texts");
  for (const auto& [key, value] : found->items())
    RequireType(path, value.is_string(), "'" + key + "' in its '__metadata__'", value, "a text");
  if (!found->contains(kMetadataKey)) Refuse(path, no_metadata);
  json parsed;
  try {
    parsed = base::ParseStrictJson(found->at(kMetadataKey).get<std::string>());
  } catch (const base::KeyTwiceError& error) {
    Refuse(path, std::string("its metadata ") + error.what() + "; damaged");
  }
  if (parsed.is_discarded()) Refuse(path, "its metadata is damaged");
  RequireType(path, parsed.is_object(), "what its metadata holds", parsed, "an object");
  if (parsed.empty())
    Refuse(path, "its metadata is empty: it does not say what task and network it is of");
  return parsed;
}

std::string LittleEndian(std::uint64_t value) {
  std::string bytes(8, '\0');
  for (std::size_t i = 0; i < 8; ++i, value >>= 8) bytes[i] = static_cast<char>(value & 255);
  return bytes;
}

StoredTensor ToHalf(const std::string& path, const std::string& name, const StoredTensor& tensor) {
  const bool is_half = tensor.type == StoredTensor::Type::kHalf;
  StoredTensor half = is_half ? tensor : HalfTensor(tensor.shape, ToFloats(tensor));
  if (!AllFinite(ToFloats(half))) {
    Refuse(path, "tensor '" + name +
                     "' has values that 16-bit floats cannot hold; did training diverge?");
  }
  return half;
}

}  // namespace

std::size_t BytesOf(StoredTensor::Type type) {
  return type == StoredTensor::Type::kHalf ? sizeof(std::uint16_t) : sizeof(float);
}

StoredTensor HalfTensor(const std::vector<std::int64_t>& shape, const std::vector<float>& values) {
  StoredTensor tensor{StoredTensor::Type::kHalf, shape, {}};
  tensor.bytes.resize(values.size() * sizeof(std::uint16_t));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint16_t half = FloatToHalf(values[i]);
    std::memcpy(tensor.bytes.data() + i * sizeof half, &half, sizeof half);
  }
  return tensor;
}

std::vector<float> ToFloats(const StoredTensor& tensor) {
  std::vector<float> values(tensor.bytes.size() / BytesOf(tensor.type));
  if (tensor.type == StoredTensor::Type::kFloat) {
    if (!values.empty()) std::memcpy(values.data(), tensor.bytes.data(), tensor.bytes.size());
    return values;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::uint16_t half = 0;
    std::memcpy(&half, tensor.bytes.data() + i * sizeof half, sizeof half);
    values[i] = HalfToFloat(half);
  }
  return values;
}

bool AllFinite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](float value) { return std::isfinite(value); });
}

WeightsFile ReadWeights(const std::string& path) {
  const std::string bytes = ReadBytes(path);
  const std::uint64_t length = HeaderLength(path, bytes);
  const json header = ParseHeader(path, bytes, length);
  const std::size_t data_begin = 8 + length;
  WeightsFile file;
  file.metadata = MetadataOf(path, header);
  std::vector<Place> places;
  for (const auto& item : header.items()) {
    if (item.key() == "__metadata__") continue;
    Entry entry = EntryOf(path, item.key(), item.value(), bytes.size() - data_begin);
    places.push_back(entry.place);
    file.tensors[item.key()] = {
        entry.type, std::move(entry.shape),
        bytes.substr(data_begin + entry.place.begin, entry.place.end - entry.place.begin)};
  }
  RequireNoGaps(path, std::move(places), bytes.size() - data_begin);
  file.hash = base::HashText(bytes);
  return file;
}

void WriteWeights(const std::string& path, const std::map<std::string, StoredTensor>& tensors,
                  const json& metadata) {
  json header;
  header["__metadata__"] = {{kMetadataKey, metadata.dump()}};
  std::string data;
  for (const auto& [name, tensor] : tensors) {
    const StoredTensor half = ToHalf(path, name, tensor);
    const std::size_t begin = data.size();
    data.append(half.bytes);
    header[name] = {
        {"dtype", "F16"}, {"shape", half.shape}, {"data_offsets", {begin, data.size()}}};
  }
  std::string text = header.dump();
  text.resize((text.size() + 7) / 8 * 8, ' ');  // the format aligns the data to 8 bytes
  base::WriteFile(path, LittleEndian(text.size()) + text + data);
}

std::uint64_t WeightsFileHash(const std::string& path) { return base::HashText(ReadBytes(path)); }

bool HasModule(const WeightsFile& file, const std::string& prefix) {
  const auto found = file.tensors.lower_bound(prefix + ".");
  return found != file.tensors.end() && found->first.starts_with(prefix + ".");
}

std::vector<float> NetworkTensor(const WeightsFile& file, const std::string& path,
                                 const std::string& name, const std::vector<std::int64_t>& shape) {
  const auto found = file.tensors.find(name);
  if (found == file.tensors.end()) Refuse(path, "has no tensor '" + name + "'; another network?");
  if (found->second.shape != shape) {
    Refuse(path, "tensor '" + name + "' has another shape than this task's network");
  }
  std::vector<float> values = ToFloats(found->second);
  if (!AllFinite(values))
    Refuse(path, "tensor '" + name + "' has values that are not numbers; damaged");
  return values;
}

NetworkConfig NetworkConfigOf(const WeightsFile& file, const std::string& path) {
  NetworkConfig config;
  try {
    file.metadata.at("network").get_to(config);
  } catch (const std::exception& error) {
    throw WeightsError(path + ": its network configuration is not understood (" + error.what() +
                       ")");
  }
  return config;
}

}  // namespace prospect::model

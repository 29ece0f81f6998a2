#include "model/weights.h"

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

torch::Dtype TypeOf(const std::string& path, const std::string& name, const std::string& text) {
  if (text == "F16") return torch::kHalf;
  if (text == "F32") return torch::kFloat;
  Refuse(path, "tensor '" + name + "' has type " + text + "; F16 and F32 are understood");
}

struct Place {
  std::size_t begin = 0, end = 0;
};

/// One entry of the header, checked against the number of data bytes.
struct Entry {
  torch::Dtype type = torch::kHalf;
  std::vector<int64_t> shape;
  Place place;
};

Entry EntryOf(const std::string& path, const std::string& name, const json& item,
              std::size_t data_bytes) {
  Entry entry;
  std::vector<std::size_t> offsets;
  try {
    entry.type = TypeOf(path, name, item.at("dtype").get<std::string>());
    entry.shape = item.at("shape").get<std::vector<int64_t>>();
    offsets = item.at("data_offsets").get<std::vector<std::size_t>>();
  } catch (const json::exception&) {
    Refuse(path, "the header's entry of tensor '" + name + "' is damaged");
  }
  std::size_t count = 1;
  for (const int64_t extent : entry.shape) {
    if (extent < 0 || extent > (1 << 28)) Refuse(path, "tensor '" + name + "' has a bad shape");
    count *= static_cast<std::size_t>(extent);
    if (count > (std::size_t{1} << 32)) Refuse(path, "tensor '" + name + "' is too large");
  }
  const std::size_t bytes = count * (entry.type == torch::kHalf ? 2 : 4);
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

torch::Tensor ToHalf(const std::string& path, const std::string& name,
                     const torch::Tensor& tensor) {
  const torch::Tensor half = tensor.detach().to(torch::kCPU).to(torch::kHalf).contiguous();
  if (!torch::isfinite(half.to(torch::kFloat)).all().item<bool>()) {
    Refuse(path, "tensor '" + name +
                     "' has values that 16-bit floats cannot hold; did training diverge?");
  }
  return half;
}

}  // namespace

WeightsFile ReadWeights(const std::string& path) {
  const std::string bytes = ReadBytes(path);
  const std::uint64_t length = HeaderLength(path, bytes);
  const json header = ParseHeader(path, bytes, length);
  const char* data = bytes.data() + 8 + length;
  const std::size_t data_bytes = bytes.size() - 8 - length;
  WeightsFile file;
  file.metadata = MetadataOf(path, header);
  std::vector<Place> places;
  for (const auto& item : header.items()) {
    if (item.key() == "__metadata__") continue;
    const Entry entry = EntryOf(path, item.key(), item.value(), data_bytes);
    places.push_back(entry.place);
    torch::Tensor tensor = torch::empty(entry.shape, entry.type);
    if (tensor.numel() > 0) {
      std::memcpy(tensor.data_ptr(), data + entry.place.begin, entry.place.end - entry.place.begin);
    }
    file.tensors.emplace(item.key(), std::move(tensor));
  }
  RequireNoGaps(path, std::move(places), data_bytes);
  file.hash = base::HashText(bytes);
  return file;
}

void WriteWeights(const std::string& path, const std::map<std::string, torch::Tensor>& tensors,
                  const json& metadata) {
  json header;
  header["__metadata__"] = {{kMetadataKey, metadata.dump()}};
  std::string data;
  for (const auto& [name, tensor] : tensors) {
    const torch::Tensor half = ToHalf(path, name, tensor);
    const std::size_t begin = data.size();
    data.append(static_cast<const char*>(half.data_ptr()), half.nbytes());
    header[name] = {
        {"dtype", "F16"}, {"shape", half.sizes().vec()}, {"data_offsets", {begin, data.size()}}};
  }
  std::string text = header.dump();
  text.resize((text.size() + 7) / 8 * 8, ' ');  // the format aligns the data to 8 bytes
  base::WriteFile(path, LittleEndian(text.size()) + text + data);
}

std::uint64_t WeightsFileHash(const std::string& path) { return base::HashText(ReadBytes(path)); }

void CollectTensors(const std::string& prefix, const torch::nn::Module& module,
                    std::map<std::string, torch::Tensor>* tensors) {
  for (const auto& item : module.named_parameters()) {
    (*tensors)[prefix + "." + item.key()] = item.value().detach();
  }
}

void LoadModule(const WeightsFile& file, const std::string& path, const std::string& prefix,
                torch::nn::Module* module) {
  const torch::NoGradGuard no_grad;
  for (auto& item : module->named_parameters()) {
    const std::string name = prefix + "." + item.key();
    const auto found = file.tensors.find(name);
    if (found == file.tensors.end()) Refuse(path, "has no tensor '" + name + "'; another network?");
    if (found->second.sizes() != item.value().sizes()) {
      Refuse(path, "tensor '" + name + "' has another shape than this task's network");
    }
    const torch::Tensor value = found->second.to(torch::kFloat);
    if (!torch::isfinite(value).all().item<bool>()) {
      Refuse(path, "tensor '" + name + "' has values that are not numbers; damaged");
    }
    item.value().copy_(value);
  }
}

void LoadModule(const std::string& path, const std::string& prefix, torch::nn::Module* module) {
  LoadModule(ReadWeights(path), path, prefix, module);
}

bool HasModule(const WeightsFile& file, const std::string& prefix) {
  const auto found = file.tensors.lower_bound(prefix + ".");
  return found != file.tensors.end() && found->first.starts_with(prefix + ".");
}

}  // namespace prospect::model

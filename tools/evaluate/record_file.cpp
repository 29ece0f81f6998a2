#include "tools/evaluate/record_file.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "model/dataset.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

void Append(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::app);
  file << text << std::flush;
  if (!file) throw model::DiskError(path + ": cannot be written; check the folder and the space");
}

}  // namespace

RecordFile::RecordFile(const std::string& path, const json& key) : path_(path) {
  std::error_code ignored;
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
  std::ifstream file(path);
  std::string text;
  if (!std::getline(file, text)) {
    Append(path, key.dump() + "\n");
    return;
  }
  if (json::parse(text, nullptr, false) != key) {
    throw std::invalid_argument(path +
                                ": was made with other options or weights; take them, or "
                                "another --out");
  }
  bool cut = false;  // by a process that was killed while it wrote
  while (std::getline(file, text)) {
    cut = file.eof();
    const json record = json::parse(text, nullptr, false);
    if (record.is_object() && record.contains("seed")) records_[record["seed"]] = record;
  }
  if (cut) Append(path, "\n");
}

void RecordFile::Store(const json& record) {
  Append(path_, record.dump() + "\n");
  records_[record.at("seed")] = record;
}

}  // namespace prospect::tools

#include "tools/evaluate/record_file.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "base/line_file.h"

namespace prospect::tools {

using nlohmann::json;

RecordFile::RecordFile(const std::string& path, const json& key) : path_(path) {
  std::error_code ignored;
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
  std::ifstream file(path);
  std::string text;
  if (!std::getline(file, text)) {
    base::AppendLine(path, key.dump());
    return;
  }
  if (json::parse(text, nullptr, false) != key) {
    throw std::invalid_argument(path +
                                ": was made with other options or weights; take them, or "
                                "another --out");
  }
  while (std::getline(file, text)) {
    const json record = json::parse(text, nullptr, false);
    if (record.is_object() && record.contains("seed")) records_[record["seed"]] = record;
  }
}

void RecordFile::Store(const json& record) {
  base::AppendLine(path_, record.dump());
  records_[record.at("seed")] = record;
}

}  // namespace prospect::tools

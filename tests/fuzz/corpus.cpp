#include "tests/fuzz/corpus.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace prospect::fuzz {

std::vector<Bytes> Corpus(const std::string& type) {
  const std::string folder = std::string(PROSPECT_CORPUS) + "/" + type;
  std::vector<std::string> names;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      names.push_back(entry.path().string());
  }
  if (names.empty())
    throw std::runtime_error("no messages in " + folder + ": run tests/fuzz/record_corpus.sh");
  std::sort(names.begin(), names.end());
  std::vector<Bytes> corpus;
  for (const std::string& name : names) {
    std::ifstream file(name, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return corpus;
}

}  // namespace prospect::fuzz

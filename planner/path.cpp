#include "planner/path.h"

#include <algorithm>
#include <stdexcept>

namespace prospect::planner {
namespace {

int ParseAction(const std::string& text) {
  const bool digits = !text.empty() && text.size() <= 3 &&
                      text.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || std::stoi(text) >= kMaxActions) {
    throw std::invalid_argument("'" + text + "' is not an action: write a path as 3-0-12, or root");
  }
  return std::stoi(text);
}

}  // namespace

std::uint64_t HashPath(const Path& path) {
  std::uint64_t hash = kRootHash;
  for (const std::uint8_t action : path) hash = ExtendHash(hash, action);
  return hash;
}

std::string ToString(const Path& path) {
  if (path.empty()) return "root";
  std::string text;
  for (const std::uint8_t action : path) {
    if (!text.empty()) text += '-';
    text += std::to_string(action);
  }
  return text;
}

Path ParsePath(const std::string& text) {
  Path path;
  if (text == "root") return path;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('-', begin), text.size());
    path.push_back(static_cast<std::uint8_t>(ParseAction(text.substr(begin, end - begin))));
    begin = end + 1;
  }
  if (path.size() > kMaxPathLength) {
    throw std::invalid_argument("a path has at most 32 actions, this one " +
                                std::to_string(path.size()));
  }
  return path;
}

}  // namespace prospect::planner

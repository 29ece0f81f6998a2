#include "planner/path.h"

namespace prospect::planner {

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

}  // namespace prospect::planner

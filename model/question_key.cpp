#include "model/question_key.h"

#include <algorithm>
#include <cstring>

namespace prospect::model {

QuestionKey KeyOf(std::span<const std::byte> bytes) {
  std::uint64_t low = 0x243f6a8885a308d3ULL ^ bytes.size();
  std::uint64_t high = 0x13198a2e03707344ULL + bytes.size();
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t taken = std::min(bytes.size(), sizeof word);
    std::memcpy(&word, bytes.data(), taken);
    low = (low ^ word) * 0x9fb21c651e98df25ULL;
    low ^= low >> 29;
    high = (high + word) * 0xd6e8feb86659fd93ULL;
    high ^= high >> 32;
    bytes = bytes.subspan(taken);
  }
  return {base::Mix64(low), base::Mix64(high)};
}

}  // namespace prospect::model

#include "model/question_key.h"

#include <cstring>

namespace prospect::model {

QuestionKey KeyOf(const void* data, std::size_t bytes) {
  const auto* at = static_cast<const unsigned char*>(data);
  std::uint64_t low = 0x243f6a8885a308d3ULL ^ bytes, high = 0x13198a2e03707344ULL + bytes;
  for (std::size_t left = bytes; left > 0;) {
    std::uint64_t word = 0;
    const std::size_t taken = left < sizeof word ? left : sizeof word;
    std::memcpy(&word, at, taken);
    low = (low ^ word) * 0x9fb21c651e98df25ULL;
    low ^= low >> 29;
    high = (high + word) * 0xd6e8feb86659fd93ULL;
    high ^= high >> 32;
    at += taken;
    left -= taken;
  }
  return {base::Mix64(low), base::Mix64(high)};
}

}  // namespace prospect::model

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/hash.h"

namespace prospect::model {

/// 128 bits that stand for a question put to an engine: equal questions have equal keys, and
/// different ones differ but for an accident of 1 in 2^64 or rarer. For caches and recordings on
/// one kind of machine (floats enter by their bytes), not against an adversary.
struct QuestionKey {
  std::uint64_t low = 0, high = 0;
  bool operator==(const QuestionKey& other) const { return low == other.low && high == other.high; }
};

struct QuestionKeyHash {
  std::size_t operator()(const QuestionKey& key) const { return key.low; }
};

/// Key of some bytes: two multiplicative hashes over 64-bit words with different constants, each
/// mixed at the end. Reads 8 bytes at a time, because states are kilobytes and are hashed a row.
QuestionKey KeyOf(std::span<const std::byte> bytes);

/// Key of an ordered pair of a question so far and one more number or key.
inline QuestionKey Join(const QuestionKey& a, const QuestionKey& b) {
  return {base::Mix64(a.low * 31 + b.low),
          base::Mix64(a.high ^ base::Mix64(b.high + 0x632be59bd9b4e019ULL))};
}
inline QuestionKey Join(const QuestionKey& a, std::uint64_t number) {
  return Join(a, QuestionKey{base::Mix64(number), base::Mix64(~number)});
}

}  // namespace prospect::model

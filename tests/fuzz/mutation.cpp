#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <iterator>

namespace prospect::fuzz {
namespace {

constexpr std::size_t kFingerprint = 8;
constexpr std::size_t kMostGrowth = 64;

// From here on `bytes` may be changed: nearly always behind the fingerprint, or nothing but that
// would be tested.
std::size_t Start(std::mt19937_64& random) { return random() % 64 == 0 ? 0 : kFingerprint; }

std::size_t Place(const Bytes& bytes, std::mt19937_64& random) {
  const std::size_t start = std::min(Start(random), bytes.size());
  return bytes.size() > start ? start + random() % (bytes.size() - start) : bytes.size();
}

std::ptrdiff_t At(std::size_t place) { return static_cast<std::ptrdiff_t>(place); }

void Flip(Bytes& bytes, std::mt19937_64& random) {
  const std::size_t place = Place(bytes, random);
  if (place < bytes.size()) bytes[place] ^= static_cast<std::uint8_t>(1 + random() % 255);
}

void Plant(Bytes& bytes, std::mt19937_64& random) {
  constexpr std::uint32_t kNasty[] = {
      0xffffffffu, 0xfffffffeu, 0x80000000u, 0x7fffffffu, 0x40000000u, 0x10000000u, 0x00ffffffu,
      0x0000ffffu, 0x00000100u, 0x7f800000u, 0x7fc00000u, 1u,          0u};
  const std::size_t place = Place(bytes, random);
  if (place + 4 > bytes.size()) return;
  const std::uint32_t value = kNasty[random() % std::size(kNasty)];
  for (std::size_t i = 0; i < 4; ++i)
    bytes[place + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

// A part of `other`, at most kMostGrowth bytes.
Bytes Part(const Bytes& other, std::mt19937_64& random) {
  const std::size_t from = Place(other, random);
  const std::size_t size = std::min<std::size_t>(other.size() - from, random() % kMostGrowth);
  return Bytes(other.begin() + At(from), other.begin() + At(from + size));
}

void Insert(Bytes& bytes, const Bytes& other, std::mt19937_64& random) {
  const Bytes part = Part(other, random);
  bytes.insert(bytes.begin() + At(Place(bytes, random)), part.begin(), part.end());
}

void Overwrite(Bytes& bytes, const Bytes& other, std::mt19937_64& random) {
  const Bytes part = Part(other, random);
  const std::size_t place = Place(bytes, random);
  const std::size_t size = std::min(part.size(), bytes.size() - place);
  std::copy(part.begin(), part.begin() + At(size), bytes.begin() + At(place));
}

void CutOut(Bytes& bytes, std::mt19937_64& random) {
  const std::size_t from = Place(bytes, random);
  const std::size_t size = std::min<std::size_t>(bytes.size() - from, random() % kMostGrowth);
  bytes.erase(bytes.begin() + At(from), bytes.begin() + At(from + size));
}

void Resize(Bytes& bytes, std::mt19937_64& random) {
  bytes.resize(random() % (bytes.size() + kMostGrowth), static_cast<std::uint8_t>(random()));
}

void Change(Bytes& bytes, const std::vector<Bytes>& corpus, std::mt19937_64& random) {
  const Bytes& other = corpus[random() % corpus.size()];
  switch (random() % 8) {
    case 0:
    case 1:
      return Flip(bytes, random);
    case 2:
    case 3:
      return Plant(bytes, random);
    case 4:
      return Insert(bytes, other, random);
    case 5:
      return Overwrite(bytes, other, random);
    case 6:
      return CutOut(bytes, random);
    default:
      return Resize(bytes, random);
  }
}

}  // namespace

Bytes Mutate(const std::vector<Bytes>& corpus, std::mt19937_64& random) {
  Bytes bytes = corpus[random() % corpus.size()];
  for (auto changes = 1 + random() % 4; changes > 0; --changes) Change(bytes, corpus, random);
  return bytes;
}

}  // namespace prospect::fuzz

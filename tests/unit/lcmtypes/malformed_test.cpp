// Hostile bytes of every kind, made from real messages by a fixed seed. What must hold: no crash,
// no exception, no allocation beyond what the bytes could hold, and whatever is accepted encodes to
// the very same bytes but for the seal. Half of the payloads claim to have no seal, so that they
// reach the generated decoders.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

#include "lcmtypes/checked_codec.h"
#include "tests/unit/lcmtypes/random_message.h"

namespace {
std::atomic<std::size_t> allocated{0};

void* Allocate(std::size_t size) {
  allocated += size;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return Allocate(size); }
void* operator new[](std::size_t size) { return Allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace prospect::messages {
namespace {

using Bytes = std::vector<std::uint8_t>;

// A decoded element takes at most this many times the bytes it takes on the wire (path_t: 32 for
// 4), vectors included.
constexpr std::size_t kGrowth = 16;
constexpr int kPayloadsPerType = 40000;

struct Tally {
  int payloads = 0;
  int accepted = 0;
};

// Bytes of the seal at a message's end; 0 for types that have none.
template <class T>
std::size_t SealBytes() {
  return std::string(SchemaOf<T>().fields.back().name) == "seal" ? 8 : 0;
}

template <class T>
void Unseal(Bytes& bytes) {
  const std::size_t seal = std::min(bytes.size(), SealBytes<T>());
  std::fill(bytes.end() - static_cast<long>(seal), bytes.end(), std::uint8_t{0});
}

template <class T>
void Feed(const Bytes& bytes, Tally& tally) {
  const std::size_t before = allocated;
  const auto result = CheckedDecode<T>(bytes.data(), bytes.size());
  const std::size_t used = allocated - before;
  ASSERT_LE(used, kGrowth * bytes.size()) << T::getTypeName();
  ++tally.payloads;
  if (!result.ok()) return;
  ++tally.accepted;
  const std::size_t covered = bytes.size() - SealBytes<T>();
  Bytes again = CheckedEncode(result.value);
  again.resize(bytes.size());
  ASSERT_TRUE(std::equal(bytes.begin(), bytes.begin() + static_cast<long>(covered), again.begin()))
      << T::getTypeName();
}

void FlipBytes(Bytes& bytes, std::mt19937_64& random) {
  const auto flips = 1 + random() % 4;
  for (std::size_t i = 0; i < flips; ++i) {
    bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
  }
}

// Numbers that break decoders, written over four bytes anywhere behind the fingerprint.
void PlantLength(Bytes& bytes, std::mt19937_64& random) {
  constexpr std::uint32_t kNasty[] = {0xffffffffu, 0x80000000u, 0x7fffffffu, 0x40000000u,
                                      0x10000000u, 0x00ffffffu, 0x0000ffffu, 0x00000100u,
                                      1u,          0u};
  if (bytes.size() < 12) return;
  const std::uint32_t value = kNasty[random() % std::size(kNasty)];
  const std::size_t at = 8 + random() % (bytes.size() - 11);
  for (std::size_t i = 0; i < 4; ++i)
    bytes[at + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

void Resize(Bytes& bytes, std::mt19937_64& random) {
  bytes.resize(random() % (bytes.size() + 16), static_cast<std::uint8_t>(random()));
}

Bytes Spoil(Bytes bytes, std::mt19937_64& random) {
  const auto ways = random() % 8;
  if (ways & 1) FlipBytes(bytes, random);
  if (ways & 2) PlantLength(bytes, random);
  if ((ways & 4) || ways == 0) Resize(bytes, random);
  return bytes;
}

template <class T>
class Malformed : public testing::Test {
 protected:
  void SetUp() override { SchemaOf<T>(); }  // the table is built once, and is no part of decoding
};
TYPED_TEST_SUITE(Malformed, AllTypes::As<testing::Types>);

TYPED_TEST(Malformed, SpoiltMessagesDoNoHarm) {
  std::mt19937_64 random(7);
  Tally tally;
  Bytes message;
  for (int i = 0; i < kPayloadsPerType && !this->HasFatalFailure(); ++i) {
    if (i % 8 == 0) message = CheckedEncode(RandomMessage<TypeParam>(random));
    Bytes spoilt = Spoil(message, random);
    if (random() % 2) Unseal<TypeParam>(spoilt);
    Feed<TypeParam>(spoilt, tally);
  }
  EXPECT_EQ(tally.payloads, kPayloadsPerType);
  EXPECT_LT(tally.accepted, tally.payloads);  // or nothing was spoilt
}

TYPED_TEST(Malformed, EveryTruncationAndEveryByteChangedDoNoHarm) {
  std::mt19937_64 random(8);
  const Bytes whole = CheckedEncode(RandomMessage<TypeParam>(random));
  Tally tally;
  for (std::size_t i = 0; i < whole.size() && !this->HasFatalFailure(); ++i) {
    Feed<TypeParam>(Bytes(whole.begin(), whole.begin() + static_cast<long>(i)), tally);
    for (const int change : {0x01, 0x80, 0xff}) {
      Bytes changed = whole;
      changed[i] = static_cast<std::uint8_t>(changed[i] ^ change);
      Feed<TypeParam>(changed, tally);
    }
  }
  EXPECT_EQ(tally.payloads, static_cast<int>(4 * whole.size()));
}

TYPED_TEST(Malformed, NoiseBehindAGoodFingerprintDoesNoHarm) {
  std::mt19937_64 random(9);
  const Bytes head = CheckedEncode(TypeParam{});
  Tally tally;
  for (int i = 0; i < 2000 && !this->HasFatalFailure(); ++i) {
    Bytes bytes(head.begin(), head.begin() + 8);
    const auto size = random() % 200;
    for (std::size_t k = 0; k < size; ++k)
      bytes.push_back(static_cast<std::uint8_t>(random() % 5 ? 0 : random()));
    Feed<TypeParam>(bytes, tally);
  }
  EXPECT_EQ(tally.payloads, 2000);
}

// The message that makes the generated decoder ask for gigabytes.
TEST(MalformedExample, AHugeCountAllocatesNothing) {
  SchemaOf<search_image_t>();
  Bytes bytes = CheckedEncode(search_image_t{});
  for (std::size_t i = bytes.size() - 12; i < bytes.size() - 8; ++i) bytes[i] = 0x7f;
  const std::size_t before = allocated;
  const auto result = CheckedDecode<search_image_t>(bytes.data(), bytes.size());
  EXPECT_EQ(allocated, before);
  EXPECT_STREQ(result.reason, "length");
}

}  // namespace
}  // namespace prospect::messages

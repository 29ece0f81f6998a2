#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "lcmtypes/checked_codec.h"
#include "tests/unit/lcmtypes/random_message.h"

namespace prospect::messages {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class T>
class EveryType : public testing::Test {};
TYPED_TEST_SUITE(EveryType, AllTypes::As<testing::Types>);

template <class T>
const char* ReasonOf(const Bytes& bytes) {
  const auto result = CheckedDecode<T>(bytes.data(), bytes.size());
  return result.ok() ? "ok" : result.reason;
}

void PutInt32(Bytes& bytes, std::size_t at, std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  for (std::size_t i = 0; i < 4; ++i)
    bytes[at + i] = static_cast<std::uint8_t>(bits >> (24 - 8 * i));
}

// Bytes are compared and not fields: NaNs differ from themselves.
TYPED_TEST(EveryType, RoundTrips) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    const Bytes bytes = CheckedEncode(RandomMessage<TypeParam>(random));
    const auto decoded = CheckedDecode<TypeParam>(bytes.data(), bytes.size());
    ASSERT_TRUE(decoded.ok()) << decoded.reason;
    EXPECT_EQ(bytes, CheckedEncode(decoded.value));
  }
}

TYPED_TEST(EveryType, RefusesOtherTypesByFingerprint) {
  Bytes bytes = CheckedEncode(TypeParam{});
  bytes[3] ^= 1;
  EXPECT_STREQ("fingerprint", ReasonOf<TypeParam>(bytes));
}

TYPED_TEST(EveryType, RefusesTrailingBytes) {
  Bytes bytes = CheckedEncode(TypeParam{});
  bytes.push_back(0);
  EXPECT_STREQ("trailing", ReasonOf<TypeParam>(bytes));
}

TYPED_TEST(EveryType, RefusesNothingAtAll) {
  EXPECT_STREQ("truncated", CheckedDecode<TypeParam>(nullptr, 0).reason);
}

// A cut inside an array or string shows as a length that exceeds the bytes left.
TYPED_TEST(EveryType, RefusesEveryTruncation) {
  std::mt19937_64 random(2);
  const Bytes whole = CheckedEncode(RandomMessage<TypeParam>(random));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string reason =
        ReasonOf<TypeParam>(Bytes(whole.begin(), whole.begin() + static_cast<long>(size)));
    EXPECT_TRUE(reason == "truncated" || reason == "length") << reason << " at " << size;
  }
}

TYPED_TEST(EveryType, SetCountsMakesAMessageEncodable) {
  std::mt19937_64 random(3);
  TypeParam message = RandomMessage<TypeParam>(random);
  const Bytes bytes = CheckedEncode(message);
  SetCounts(message);
  EXPECT_EQ(bytes, CheckedEncode(message));
}

// Whatever the walk lets pass, the seal does not: no changed byte is believed.
TYPED_TEST(EveryType, SealedMessagesCannotBeChanged) {
  const auto& fields = SchemaOf<TypeParam>().fields;
  if (std::string(fields.back().name) != "seal") return;
  std::mt19937_64 random(4);
  const Bytes whole = CheckedEncode(RandomMessage<TypeParam>(random));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    Bytes bytes = whole;
    bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1 + random() % 255));
    EXPECT_STRNE("ok", ReasonOf<TypeParam>(bytes)) << "byte " << at;
  }
}

search_stop_t Stop(std::int64_t search_id) {
  search_stop_t stop{};
  stop.search_id = search_id;
  return stop;
}

TEST(Seal, IsReportedWhenItDoesNotHold) {
  Bytes bytes = CheckedEncode(Stop(5));
  bytes[23] ^= 1;  // the last byte of search_id
  EXPECT_STREQ("seal", ReasonOf<search_stop_t>(bytes));
}

TEST(Seal, MayBeMissing) {
  Bytes bytes = CheckedEncode(Stop(5));
  std::fill(bytes.end() - 8, bytes.end(), std::uint8_t{0});
  EXPECT_STREQ("ok", ReasonOf<search_stop_t>(bytes));
}

TEST(Seal, IsOnEveryTypeThatTravelsAlone) {
  for (const TypeSchema& type : Schema()) {
    const bool travels = type.fields[0].name == std::string("utime");
    // Statistics bring a checksum that the planner makes and checks.
    const char* last = travels && std::string(type.name) != "search_statistics_t" ? "seal" : "";
    const bool sealed = std::string(type.fields.back().name) == "seal";
    EXPECT_EQ(sealed, std::string(last) == "seal") << type.name;
  }
}

// path_t: fingerprint, int32 num_actions, bytes.
constexpr std::size_t kPathCount = 8;

TEST(LengthWalk, RefusesNegativeCounts) {
  Bytes bytes = CheckedEncode(path_t{2, {0, 1}});
  PutInt32(bytes, kPathCount, -1);
  EXPECT_STREQ("length", ReasonOf<path_t>(bytes));
}

TEST(LengthWalk, RefusesHugeCounts) {
  Bytes bytes = CheckedEncode(path_t{2, {0, 1}});
  for (const std::int32_t count : {3, 4096, 0x7fffffff}) {
    PutInt32(bytes, kPathCount, count);
    EXPECT_STREQ("length", ReasonOf<path_t>(bytes)) << count;
  }
}

TEST(LengthWalk, CountsTooSmallLeaveBytesOver) {
  Bytes bytes = CheckedEncode(path_t{2, {0, 1}});
  PutInt32(bytes, kPathCount, 1);
  EXPECT_STREQ("trailing", ReasonOf<path_t>(bytes));
}

// counter_t: fingerprint, int32 length of name with its zero, name, int64 value.
TEST(LengthWalk, RefusesBadStringLengths) {
  Bytes bytes = CheckedEncode(counter_t{"abc", 7});
  for (const std::int32_t length : {0, -1, -2147483647, 3, 1000, 0x7fffffff}) {
    PutInt32(bytes, 8, length);
    EXPECT_STREQ("length", ReasonOf<counter_t>(bytes)) << length;
  }
}

TEST(LengthWalk, RefusesStringsWithoutTheirZero) {
  Bytes bytes = CheckedEncode(counter_t{"abc", 7});
  bytes[8 + 4 + 3] = 'd';
  EXPECT_STREQ("length", ReasonOf<counter_t>(bytes));
}

TEST(LengthWalk, RefusesStringsWithAZeroInside) {
  Bytes bytes = CheckedEncode(counter_t{"abc", 7});
  bytes[8 + 4 + 1] = 0;
  EXPECT_STREQ("length", ReasonOf<counter_t>(bytes));
}

TEST(LengthWalk, RefusesBadCountsOfNestedMessages) {
  expand_request_t request{};
  request.paths = {{1, {5}}, {0, {}}};
  SetCounts(request);
  Bytes bytes = CheckedEncode(request);
  // The second path now announces more actions than there are bytes left, those of the seal
  // included.
  PutInt32(bytes, bytes.size() - 12, 9);
  EXPECT_STREQ("length", ReasonOf<expand_request_t>(bytes));
}

TEST(Encode, RefusesACountThatDiffersFromTheArray) {
  EXPECT_THROW(CheckedEncode(path_t{3, {0, 1}}), EncodeError);
  EXPECT_THROW(CheckedEncode(path_t{-1, {}}), EncodeError);
}

TEST(Encode, RefusesANestedCountThatDiffers) {
  expand_request_t request{};
  request.num_paths = 1;
  request.paths = {{7, {1}}};
  EXPECT_THROW(CheckedEncode(request), EncodeError);
}

TEST(Encode, SetCountsRefusesArraysThatShareACountAndDiffer) {
  evaluation_t evaluation{};
  evaluation.actions = {1, 2};
  evaluation.q = {1, 2};
  evaluation.p = {1};
  EXPECT_THROW(SetCounts(evaluation), EncodeError);
}

TEST(Encode, ErrorNamesTypeAndField) {
  try {
    CheckedEncode(path_t{3, {0, 1}});
    FAIL() << "no error";
  } catch (const EncodeError& error) {
    EXPECT_NE(std::string(error.what()).find("path_t.actions"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace prospect::messages

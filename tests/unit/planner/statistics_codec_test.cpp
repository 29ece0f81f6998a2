#include "planner/statistics_codec.h"

#include <gtest/gtest.h>

#include <random>

namespace prospect::planner {
namespace {

StatisticsBatch Empty() {
  StatisticsBatch batch;
  batch.writer = 7;
  batch.sequence = 31;
  return batch;
}

StatisticsRow Row(std::uint64_t writer, const Path& path, std::int64_t visits, std::int64_t sum,
                  std::int64_t best, std::int32_t in_flight) {
  return {writer,   path, writer == 7 ? 31u : 0u,
          visits,   sum,  static_cast<float>(static_cast<double>(best) / kValueOne),
          in_flight};
}

void ExpectSame(const std::vector<StatisticsRow>& a, const std::vector<StatisticsRow>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].writer, b[i].writer);
    EXPECT_EQ(a[i].path, b[i].path);
    EXPECT_EQ(a[i].version, b[i].version);
    EXPECT_EQ(a[i].visits, b[i].visits);
    EXPECT_EQ(a[i].value_sum, b[i].value_sum);
    EXPECT_EQ(a[i].best, b[i].best);
    EXPECT_EQ(a[i].in_flight, b[i].in_flight);
  }
}

void ExpectReturn(const StatisticsBatch& batch) {
  const std::vector<std::uint8_t> bytes = PackRows(batch);
  StatisticsBatch back = Empty();
  ASSERT_TRUE(UnpackRows(bytes, &back));
  ExpectSame(batch.rows, back.rows);
}

TEST(StatisticsCodec, BytesAsDescribed) {
  StatisticsBatch batch = Empty();
  batch.rows = {Row(7, {}, 2, kValueOne, kValueOne, 0), Row(7, {3}, 1, 5, 5, 2)};
  const std::vector<std::uint8_t> expected = {
      0,                                               // no other writers
      0,    0, 2, 0x80, 0x80, 0x40, 0x80, 0x80, 0x40,  // the root: N, W and v* of one each
      0x60, 3, 1, 5,    2,                             // one action, O follows; v* is W
  };
  EXPECT_EQ(PackRows(batch), expected);
  EXPECT_EQ(RowBytes(batch.rows[0], false), 9u);
  EXPECT_EQ(RowBytes(batch.rows[1], false), 5u);
}

TEST(StatisticsCodec, EveryRowComesBack) {
  ExpectReturn(Empty());
  StatisticsBatch batch = Empty();
  batch.rows = {Row(7, {}, 0, 0, 0, 3),
                Row(7, Path(kMaxPathLength, 254), 1, kValueOne, kValueOne, 0),
                Row(7, Path(kMaxPathLength, 254), 3, 3 * kValueOne, kValueOne, 2'000'000'000),
                Row(~0ull, {1}, std::int64_t{1} << 40, std::int64_t{1} << 59, 77, 0),
                Row(9, {1, 2}, 2, 1, 1, 0),
                Row(7, {1, 2, 3}, 2, 1, 0, 0)};
  ExpectReturn(batch);
}

// What shares more than a head can say costs what is written out, and budgets count it.
TEST(StatisticsCodec, BudgetsCountTheLongestPaths) {
  for (std::size_t length = 1; length <= kMaxPathLength; ++length) {
    StatisticsBatch batch = Empty();
    batch.rows = {Row(7, Path(length, 254), 1, 5, 5, 0)};
    const std::size_t alone = PackRows(batch).size();
    batch.rows.push_back(Row(7, Path(length, 254), 1, 5, 5, 0));
    batch.rows.back().path.back() = 253;
    EXPECT_EQ(PackRows(batch).size() - alone, RowBytes(batch.rows.back(), false)) << length;
    ExpectReturn(batch);
  }
}

TEST(StatisticsCodec, RandomRowsComeBack) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    StatisticsBatch batch = Empty();
    Path path;
    for (int i = 0; i < 200; ++i) {
      if (!path.empty() && random() % 3 == 0) path.pop_back();
      if (path.size() < kMaxPathLength && random() % 5 < 3) path.push_back(random() % 255);
      const auto visits = static_cast<std::int64_t>(random() % 200);
      const auto best = static_cast<std::int64_t>(random() % (kValueOne + 1));
      const std::int64_t sum = visits < 2 ? visits * best : static_cast<std::int64_t>(random());
      const std::uint64_t writer = random() % 3 == 0 ? 7 : 100 + random() % 5;
      batch.rows.push_back(Row(writer, path, visits, sum, visits == 0 ? 0 : best, random() % 2));
    }
    ExpectReturn(batch);
  }
}

TEST(StatisticsCodec, UsualRowsAreShort) {
  StatisticsBatch batch = Empty();
  for (std::uint8_t a = 0; a < 8; ++a) {
    batch.rows.push_back(Row(7, {a}, 9, 4 * kValueOne, kValueOne / 2, 0));
    for (std::uint8_t b = 0; b < 8; ++b) {
      batch.rows.push_back(Row(7, {a, b}, 1, kValueOne / 2, kValueOne / 2, 0));
    }
  }
  const std::size_t rows = batch.rows.size();
  EXPECT_LE(PackRows(batch).size(), rows * 7);
}

// Bytes that are no rows are refused whole; nothing is read beyond them, nothing big is allocated.
TEST(StatisticsCodec, RefusesWhatIsNoRows) {
  const auto refused = [](std::vector<std::uint8_t> bytes) {
    StatisticsBatch back = Empty();
    const bool read = UnpackRows(bytes, &back);
    EXPECT_TRUE(read || back.rows.empty());
    return !read;
  };
  EXPECT_TRUE(refused({}));
  EXPECT_FALSE(refused({0}));
  EXPECT_TRUE(refused({1}));                                   // a table cut short
  EXPECT_TRUE(refused({0xff, 0xff, 0xff, 0xff, 0x0f}));        // a huge table
  EXPECT_TRUE(refused({0, 0x01, 0, 1, 0}));                    // shares what is not there
  EXPECT_TRUE(refused({0, 0x80, 1, 0, 0}));                    // a writer beyond the table
  EXPECT_TRUE(refused({0, 0x00, 65}));                         // a path too long
  EXPECT_TRUE(refused({0, 0x20, 3, 2, 5, 0x81, 0x80, 0x40}));  // v* above 1
  EXPECT_TRUE(refused({0, 0x20, 3, 0x80}));                    // a number cut short
  EXPECT_TRUE(refused({0, 0x20, 3, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f}));
  EXPECT_TRUE(refused({0, 0x60, 3, 0, 0xff, 0xff, 0xff, 0xff, 0x7f}));  // O beyond 31 bits
}

TEST(StatisticsCodec, SurvivesNoise) {
  std::mt19937 random(11);
  int read = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    std::vector<std::uint8_t> bytes(random() % 60);
    for (std::uint8_t& byte : bytes) byte = random() % 4 == 0 ? random() : random() % 8;
    StatisticsBatch back = Empty();
    if (!UnpackRows(bytes, &back)) continue;
    ++read;
    for (const StatisticsRow& row : back.rows) {
      EXPECT_LE(row.path.size(), 32u);
      EXPECT_GE(row.visits, 0);
      EXPECT_GE(row.in_flight, 0);
      EXPECT_LE(row.best, 1.0f);
    }
  }
  EXPECT_GT(read, 100);
}

}  // namespace
}  // namespace prospect::planner

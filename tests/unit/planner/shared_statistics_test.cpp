#include "planner/shared_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>

namespace prospect::planner {
namespace {

constexpr SearchId kSearch{42, 1};
constexpr std::size_t kPlenty = 1 << 20;
constexpr std::int64_t kSecond = 1'000'000;

// A table with the path tree it refers to.
struct Table {
  explicit Table(std::uint64_t writer, SearchId search = kSearch)
      : tree(4), statistics(&tree, Options(writer, search)) {}
  explicit Table(const SharedStatisticsOptions& options) : tree(4), statistics(&tree, options) {}
  static SharedStatisticsOptions Options(std::uint64_t writer, SearchId search) {
    SharedStatisticsOptions options;
    options.search = search;
    options.writer = writer;
    return options;
  }
  // One rollout to `path` with the same value at every node.
  void Visit(const Path& path, double value) {
    Begin(path);
    for (PathId id = tree.Find(path); id != kNoPath; id = tree.parent(id)) {
      statistics.Complete(id, value);
    }
  }
  void Begin(const Path& path) {
    for (PathId id = tree.Add(path); id != kNoPath; id = tree.parent(id)) statistics.Begin(id);
  }
  PathTotals At(const Path& path) const { return statistics.totals(tree.Find(path)); }

  PathTree tree;
  SharedStatistics statistics;
};

// A batch from a writer of its own, with one row, for things that an honest writer never sends.
StatisticsBatch Crafted(const StatisticsRow& row, std::uint64_t sequence = 1) {
  StatisticsBatch batch;
  batch.search = kSearch;
  batch.writer = 9;
  batch.sequence = sequence;
  batch.rows = {row};
  batch.checksum = PayloadChecksum(batch);
  return batch;
}

StatisticsRow Row(std::uint64_t version, std::int64_t visits, std::int32_t in_flight = 0) {
  return {9, {1}, version, visits, visits * kValueOne / 2, visits > 0 ? 0.5f : 0.0f, in_flight};
}

TEST(SharedStatistics, CountsOwnRollouts) {
  Table table(1);
  table.Begin({2, 0});
  EXPECT_EQ(table.At({2}).in_flight, 1);
  EXPECT_EQ(table.At({}).visits, 0);
  table.statistics.Cancel(table.tree.Find({2, 0}));
  EXPECT_EQ(table.At({2, 0}).in_flight, 0);
  table.Visit({2}, 0.25);
  table.Visit({2}, 0.75);
  EXPECT_EQ(table.At({2}).visits, 2);
  EXPECT_DOUBLE_EQ(table.At({2}).mean(), 0.5);
  EXPECT_FLOAT_EQ(table.At({2}).best, 0.75f);
  EXPECT_EQ(table.statistics.own_in_flight(table.tree.Find({2})), 1);  // the one begun above
  EXPECT_EQ(table.statistics.TakeNewlyVisited().size(), 2u);
  EXPECT_TRUE(table.statistics.TakeNewlyVisited().empty());
}

TEST(RowIndex, FindsEachKeyAndNoOther) {
  RowIndex index;
  EXPECT_EQ(index.Find(0, 0), RowIndex::kNone);
  std::uint32_t place = 0;
  for (int writer = 1; writer < 40; ++writer) {
    for (PathId id = 0; id < 500; id += writer) index.Add(writer, id, place++);
  }
  place = 0;
  for (int writer = 1; writer < 40; ++writer) {
    for (PathId id = 0; id < 500; ++id) {
      ASSERT_EQ(index.Find(writer, id), id % writer == 0 ? place++ : RowIndex::kNone);
    }
    EXPECT_EQ(index.Find(writer + 40, 0), RowIndex::kNone);
  }
}

TEST(SharedStatistics, RefusesBadOptions) {
  PathTree tree(2);
  SharedStatisticsOptions options;
  EXPECT_THROW(SharedStatistics(&tree, options), std::invalid_argument);
  options.writer = 1;
  options.lease_us = 0;
  EXPECT_THROW(SharedStatistics(&tree, options), std::invalid_argument);
}

TEST(SharedStatistics, SumsOverWriters) {
  Table a(1), b(2);
  a.Visit({0, 1}, 0.25);
  b.Visit({0, 1}, 0.75);
  b.Begin({3});
  a.statistics.Merge(b.statistics.MakeBatch(kPlenty, 0), 0);
  EXPECT_EQ(a.At({0, 1}).visits, 2);
  EXPECT_DOUBLE_EQ(a.At({0}).mean(), 0.5);
  EXPECT_FLOAT_EQ(a.At({}).best, 0.75f);
  EXPECT_EQ(a.At({3}).in_flight, 1);
  EXPECT_EQ(a.statistics.own_in_flight(a.tree.Find({3})), 0);
  EXPECT_TRUE(a.statistics.ConvergedWithLive());
}

TEST(SharedStatistics, RepetitionChangesNothing) {
  Table a(1), b(2);
  b.Visit({0, 1}, 0.75);
  const StatisticsBatch batch = b.statistics.MakeBatch(kPlenty, 0);
  EXPECT_EQ(a.statistics.Merge(batch, 0), 3);
  EXPECT_EQ(a.statistics.Merge(batch, 0), 0);
  EXPECT_EQ(a.At({0, 1}).visits, 1);
  EXPECT_EQ(b.statistics.Merge(batch, 0), 0);  // one's own batch, brought back by the bus
  EXPECT_EQ(b.statistics.refusals().total(), 0);
}

TEST(SharedStatistics, RelaysReachThoseWhoNeverHeardTheWriter) {
  Table a(1), b(2), c(3);
  a.Visit({0, 1}, 0.75);
  a.Begin({0});
  b.statistics.Merge(a.statistics.MakeBatch(kPlenty, 0), 0);
  c.statistics.Merge(b.statistics.MakeBatch(kPlenty, 0), 0);
  EXPECT_EQ(c.At({0, 1}).visits, 1);
  EXPECT_EQ(c.At({0}).in_flight, 0);  // O is not relayed
  EXPECT_EQ(c.statistics.digest(), a.statistics.digest());
  // The writer's own word, though no newer, brings O.
  c.statistics.Merge(a.statistics.MakeBatch(kPlenty, 0), 0);
  EXPECT_EQ(c.At({0}).in_flight, 1);
  EXPECT_EQ(c.statistics.digest(), a.statistics.digest());
}

// Any subset, order and repetition of batches, then all of them once: one table.
TEST(SharedStatistics, AnyOrderOfArrivalGivesOneTable) {
  std::mt19937 random(5);
  std::vector<StatisticsBatch> batches;
  std::vector<std::unique_ptr<Table>> writers;
  for (std::uint64_t w = 1; w <= 3; ++w) writers.push_back(std::make_unique<Table>(w));
  for (int step = 0; step < 120; ++step) {
    Table& writer = *writers[random() % 3];
    Path path;
    while (path.size() < random() % 4) path.push_back(random() % 4);
    writer.Visit(path, static_cast<double>(random() % 1000) / 1000);
    if (step % 7 == 0) writer.Begin({static_cast<std::uint8_t>(random() % 4)});
    batches.push_back(writer.statistics.MakeBatch(400, 0));
    // Writers hear some of it, so that relays of every age are among the batches.
    if (random() % 2)
      writers[random() % 3]->statistics.Merge(batches[random() % batches.size()], 0);
  }
  std::uint64_t digest = 0;
  std::string table_text;
  for (int trial = 0; trial < 100; ++trial) {
    Table reader(77);
    for (int i = 0; i < trial; ++i) {
      reader.statistics.Merge(batches[random() % batches.size()], 0);
    }
    std::vector<StatisticsBatch> shuffled = batches;
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    for (const StatisticsBatch& batch : shuffled) reader.statistics.Merge(batch, 0);
    std::string text;
    for (const StatisticsRow& row : reader.statistics.AllRows()) {
      text += std::to_string(row.writer) + " " + ToString(row.path) + " " +
              std::to_string(row.version) + " " + std::to_string(row.visits) + " " +
              std::to_string(row.value_sum) + " " + std::to_string(row.best) + " " +
              std::to_string(row.in_flight) + "\n";
    }
    if (trial == 0) digest = reader.statistics.digest(), table_text = text;
    ASSERT_EQ(reader.statistics.digest(), digest);
    ASSERT_EQ(text, table_text);
    ASSERT_EQ(reader.statistics.refusals().total(), 0);
  }
  EXPECT_GT(table_text.size(), 1000u);
}

TEST(SharedStatistics, DigestTellsTablesApart) {
  Table a(1), b(1), c(2);
  a.Visit({0}, 0.5);
  b.Visit({0}, 0.500001);
  c.Visit({0}, 0.5);
  EXPECT_NE(a.statistics.digest(), b.statistics.digest());
  EXPECT_NE(a.statistics.digest(), c.statistics.digest());
  b.Visit({1}, 0.5);
  EXPECT_NE(a.statistics.rows(), b.statistics.rows());
}

// --- leases

TEST(Leases, ASilentWritersVisitsInFlightStopCounting) {
  Table a(1), b(2);
  b.Begin({3});
  b.Visit({3}, 0.5);
  a.statistics.Merge(b.statistics.MakeBatch(kPlenty, 0), 10 * kSecond);
  a.statistics.ExpireLeases(11 * kSecond);
  EXPECT_EQ(a.At({3}).in_flight, 1);
  a.statistics.ExpireLeases(11 * kSecond + 1);
  EXPECT_EQ(a.At({3}).in_flight, 0);
  EXPECT_EQ(a.At({3}).visits, 1);  // what was completed stays
  EXPECT_FALSE(a.statistics.writers()[1].live);
  // It speaks again.
  a.statistics.Merge(b.statistics.MakeBatch(kPlenty, 0), 12 * kSecond);
  EXPECT_EQ(a.At({3}).in_flight, 1);
}

TEST(Leases, DuplicatesAndRelaysDoNotRenew) {
  Table a(1), b(2), c(3);
  b.Begin({3});
  b.Visit({3}, 0.5);
  const StatisticsBatch first = b.statistics.MakeBatch(kPlenty, 0);
  const StatisticsBatch second = b.statistics.MakeBatch(kPlenty, 0);
  a.statistics.Merge(second, 0);
  c.statistics.Merge(second, 0);
  a.statistics.Merge(second, kSecond);
  a.statistics.Merge(first, kSecond);
  a.statistics.Merge(c.statistics.MakeBatch(kPlenty, 0), kSecond);
  EXPECT_EQ(a.At({3}).in_flight, 1);
  a.statistics.ExpireLeases(kSecond + 1);
  EXPECT_EQ(a.At({3}).in_flight, 0);
}

TEST(Leases, RowsThatArriveDuringSilenceCountOnlyOnRenewal) {
  Table a(1), b(2);
  b.Begin({3});
  const StatisticsBatch old = b.statistics.MakeBatch(kPlenty, 0);
  const StatisticsBatch newer = b.statistics.MakeBatch(kBatchHeaderBytes, 0);
  a.statistics.Merge(newer, 0);
  a.statistics.ExpireLeases(5 * kSecond);
  a.statistics.Merge(old, 5 * kSecond);  // late: an older sequence number renews nothing
  EXPECT_EQ(a.At({3}).in_flight, 0);
  a.statistics.Merge(b.statistics.MakeBatch(kPlenty, 0), 6 * kSecond);
  EXPECT_EQ(a.At({3}).in_flight, 1);
}

// --- refusals

TEST(Refusals, OtherSearchesAndEpochs) {
  Table a(1), other(2, {43, 1}), epoch(3, {42, 2});
  other.Visit({0}, 1);
  epoch.Visit({0}, 1);
  a.statistics.Merge(other.statistics.MakeBatch(kPlenty, 0), 0);
  a.statistics.Merge(epoch.statistics.MakeBatch(kPlenty, 0), 0);
  EXPECT_EQ(a.statistics.refusals().other_search, 2);
  EXPECT_EQ(a.statistics.rows(), 0);
}

TEST(Refusals, AnyChangedFieldBreaksTheChecksum) {
  Table a(1);
  const auto expect_refused = [&a](void (*spoil)(StatisticsBatch*)) {
    StatisticsBatch batch = Crafted(Row(1, 2));
    spoil(&batch);
    const std::int64_t before = a.statistics.refusals().checksum;
    EXPECT_EQ(a.statistics.Merge(batch, 0), 0);
    EXPECT_EQ(a.statistics.refusals().checksum, before + 1);
  };
  expect_refused([](StatisticsBatch* b) { b->rows[0].visits = 3; });
  expect_refused([](StatisticsBatch* b) { b->rows[0].best = 0.6f; });
  expect_refused([](StatisticsBatch* b) { b->rows[0].path = {2}; });
  expect_refused([](StatisticsBatch* b) { b->rows[0].in_flight = 1; });
  expect_refused([](StatisticsBatch* b) { b->rows.clear(); });
  expect_refused([](StatisticsBatch* b) { b->sequence = 8; });
  expect_refused([](StatisticsBatch* b) { b->writer = 8; });
  expect_refused([](StatisticsBatch* b) { b->totals.rollouts = 8; });
  expect_refused([](StatisticsBatch* b) { b->totals.finished = true; });
  EXPECT_EQ(a.statistics.rows(), 0);
}

TEST(Refusals, RowsOutOfRange) {
  Table a(1);
  const auto merge = [&a](void (*spoil)(StatisticsRow*)) {
    StatisticsRow row = Row(1, 2);
    spoil(&row);
    return a.statistics.Merge(Crafted(row), 0);
  };
  EXPECT_EQ(merge([](StatisticsRow* r) { r->best = 1.5f; }), 0);
  EXPECT_EQ(merge([](StatisticsRow* r) { r->best = -0.5f; }), 0);
  EXPECT_EQ(merge([](StatisticsRow* r) { r->best = std::numeric_limits<float>::quiet_NaN(); }), 0);
  EXPECT_EQ(a.statistics.refusals().best_range, 3);
  EXPECT_EQ(merge([](StatisticsRow* r) { r->in_flight = -1; }), 0);
  EXPECT_EQ(a.statistics.refusals().in_flight_range, 1);
  EXPECT_EQ(merge([](StatisticsRow* r) { r->visits = -1; }), 0);
  EXPECT_EQ(merge([](StatisticsRow* r) { r->value_sum = 3 * kValueOne; }), 0);
  EXPECT_EQ(merge([](StatisticsRow* r) { r->value_sum = -1; }), 0);
  EXPECT_EQ(a.statistics.refusals().sum_range, 3);
  EXPECT_EQ(merge([](StatisticsRow* r) { r->path = {4}; }), 0);
  EXPECT_EQ(merge([](StatisticsRow* r) { r->path = Path(65, 0); }), 0);
  EXPECT_EQ(merge([](StatisticsRow* r) { r->writer = 0; }), 0);
  EXPECT_EQ(a.statistics.refusals().path, 3);
  EXPECT_EQ(a.statistics.rows(), 0);
  EXPECT_EQ(merge([](StatisticsRow*) {}), 1);
}

TEST(Refusals, VisitsThatFallAreKeptOutInEitherOrder) {
  for (const bool falling_last : {true, false}) {
    Table a(1);
    const StatisticsBatch five = Crafted(Row(1, 5), 1), three = Crafted(Row(2, 3), 2);
    a.statistics.Merge(falling_last ? five : three, 0);
    a.statistics.Merge(falling_last ? three : five, 0);
    EXPECT_EQ(a.At({1}).visits, 5);
    EXPECT_EQ(a.statistics.refusals().visits_fell, 1);
  }
}

TEST(Refusals, RowsUnderOnesOwnName) {
  Table a(9), b(2);
  a.Visit({1}, 0.5);
  StatisticsBatch forged = Crafted(Row(100, 50));
  forged.writer = 2;
  forged.checksum = PayloadChecksum(forged);
  a.statistics.Merge(forged, 0);
  EXPECT_EQ(a.At({1}).visits, 1);
  EXPECT_EQ(a.statistics.refusals().own_row, 1);
}

TEST(Refusals, TooManyPathsOrWriters) {
  PathTree tree(4);
  SharedStatisticsOptions options;
  options.search = kSearch;
  options.writer = 1;
  options.max_paths = 2;
  options.max_writers = 2;
  SharedStatistics statistics(&tree, options);
  EXPECT_EQ(statistics.Merge(Crafted(Row(1, 1)), 0), 1);
  StatisticsRow other = Row(1, 1);
  other.path = {2};
  EXPECT_EQ(statistics.Merge(Crafted(other, 2), 0), 0);
  EXPECT_EQ(statistics.refusals().path, 1);
  EXPECT_EQ(statistics.Merge(Crafted(Row(2, 2), 3), 0), 1);  // known paths still change
  other = Row(1, 1);
  other.writer = 10;
  EXPECT_EQ(statistics.Merge(Crafted(other, 4), 0), 0);
  EXPECT_EQ(statistics.refusals().writers, 1);
}

// --- batches

TEST(Batches, CarryTheMostChangedRowsFirstWithinTheBudget) {
  Table a(1);
  for (int i = 0; i < 9; ++i) a.Visit({0}, 0.5);
  for (int i = 0; i < 5; ++i) a.Visit({1}, 0.5);
  a.Visit({2}, 0.5);
  const std::size_t budget = kBatchHeaderBytes + 40;  // three quarters of 40: three rows of 9
  const StatisticsBatch batch = a.statistics.MakeBatch(budget, 0);
  ASSERT_EQ(batch.rows.size(), 4u);
  EXPECT_EQ(batch.rows[0].path, Path{});
  EXPECT_EQ(batch.rows[1].path, Path{0});
  EXPECT_EQ(batch.rows[2].path, Path{1});
  EXPECT_EQ(batch.rows[3].path, Path{2});  // by the round-robin, which skips what is there
  // The root again, and one row by the round-robin.
  a.Visit({1}, 0.5);
  const StatisticsBatch next = a.statistics.MakeBatch(budget - 20, 0);
  ASSERT_EQ(next.rows.size(), 2u);
  EXPECT_EQ(next.rows[0].path, Path{});
  EXPECT_EQ(next.rows[0].visits, 16);
  EXPECT_EQ(next.sequence, batch.sequence + 1);
}

TEST(Batches, ParentsGoBeforeChildren) {
  Table a(1);
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    Path path;
    for (int d = 0; d < 5; ++d) path.push_back(random() % 4);
    a.Visit(path, 0.5);
  }
  const StatisticsBatch batch = a.statistics.MakeBatch(4000, 0);
  PathTree seen(4);
  std::vector<Path> sent{{}};
  const std::size_t changed = batch.rows.size() * 3 / 4;
  for (std::size_t i = 0; i < changed; ++i) {
    Path above = batch.rows[i].path;
    if (!above.empty()) above.pop_back();
    EXPECT_NE(std::find(sent.begin(), sent.end(), above), sent.end());
    sent.push_back(batch.rows[i].path);
  }
}

TEST(Batches, RoundRobinAloneCoversEverything) {
  Table a(1), b(2), late(3);
  for (std::uint8_t i = 0; i < 4; ++i) {
    for (std::uint8_t j = 0; j < 4; ++j) a.Visit({i, j}, 0.5), b.Visit({j, i}, 0.25);
  }
  a.statistics.Merge(b.statistics.MakeBatch(kPlenty, 0), 0);
  a.statistics.MakeBatch(kPlenty, 0);  // lost
  const std::int64_t before = a.statistics.round_robin_rounds();
  while (a.statistics.round_robin_rounds() < before + 2) {
    const StatisticsBatch batch = a.statistics.MakeBatch(kBatchHeaderBytes + 40, 0);
    EXPECT_LE(batch.rows.size(), 2u);
    late.statistics.Merge(batch, 0);
  }
  EXPECT_EQ(late.statistics.digest(), a.statistics.digest());
  EXPECT_EQ(late.statistics.rows(), 42);
}

TEST(Batches, NewsOfAWriterHeardOfByRelayAreToldAtOnce) {
  SharedStatisticsOptions options = Table::Options(3, kSearch);
  options.bytes_per_rollout = 20;
  Table dead(1), witness(2), heir(options), other(4);
  for (std::uint8_t i = 0; i < 64; ++i) {
    dead.Visit({std::uint8_t(i / 16), std::uint8_t(i / 4 % 4), std::uint8_t(i % 4)}, 0.5);
  }
  heir.Visit({0}, 0.5);
  heir.statistics.Merge(witness.statistics.MakeBatch(kPlenty, 0), 0);
  for (int i = 0; i < 10; ++i) heir.statistics.MakeBatch(kPlenty, 0);  // long in its steady state
  witness.statistics.Merge(dead.statistics.MakeBatch(kPlenty, 0), 0);
  heir.statistics.Merge(witness.statistics.MakeBatch(kPlenty, 0), 0);
  other.statistics.Merge(heir.statistics.MakeBatch(kPlenty, 0), 0);
  EXPECT_EQ(other.statistics.rows(), 85 + 2);
  for (int i = 0; i < 10; ++i) heir.statistics.MakeBatch(kPlenty, 0);
  EXPECT_LE(heir.statistics.MakeBatch(kPlenty, 0).rows.size(), 8u) << "it goes on telling all";
}

TEST(Batches, TotalsTellWhatIsMissing) {
  Table a(1), b(2);
  a.Visit({0, 1}, 0.5);
  a.Begin({});
  a.statistics.SetOwnEvaluations(3);
  const StatisticsBatch batch = a.statistics.MakeBatch(kBatchHeaderBytes, 0);
  EXPECT_EQ(batch.totals.rollouts, 1);
  EXPECT_EQ(batch.totals.in_flight, 1);
  EXPECT_EQ(batch.totals.evaluations, 3);
  EXPECT_EQ(batch.totals.rows, 3);
  EXPECT_FALSE(batch.totals.finished);
  b.statistics.Merge(batch, 0);
  EXPECT_FALSE(b.statistics.ConvergedWithLive());
  b.statistics.Merge(a.statistics.MakeBatch(kPlenty, 0), 0);
  EXPECT_TRUE(b.statistics.ConvergedWithLive());
}

}  // namespace
}  // namespace prospect::planner

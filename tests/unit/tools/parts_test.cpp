#include "tools/common/parts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "base/exit_codes.h"
#include "tools/common/run_items.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

cli::ShardOptions Shard(int index, int count) {
  cli::ShardOptions shard;
  shard.index = index;
  shard.count = count;
  shard.asked = {"--scenes=7"};
  return shard;
}

const json kMadeOf = {{"world_version", "w1"}};

// The words with which `work` is refused; empty: it is not.
template <typename Work>
std::string Refusal(const Work& work) {
  try {
    work();
  } catch (const PartError& error) {
    EXPECT_EQ(error.code(), kExitDataFile);
    return error.what();
  }
  return "";
}

class Parts : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string Path(const std::string& name) const { return folder_ / name; }

  // Part `index` of `count` of seven items, of which item i says i * i.
  std::string Write(int index, int count = 3, const Part* other = nullptr) {
    const Part part =
        other != nullptr ? *other : PartOf(Shard(index, count), "evaluate", 7, kMadeOf);
    std::vector<json> records;
    for (const int i : ItemsOf(Shard(index, count), 7)) records.push_back({{"square", i * i}});
    const std::string file = Path(std::to_string(++written_) + ".json");
    WriteRecords(file, part, records);
    return file;
  }

  // What is said of a second part that differs from the first.
  std::string SaidOf(const Part& second) {
    const std::string first = Write(1), other = Write(2, 3, &second);
    return Refusal([&] { ReadRecords({first, other, Write(3)}); });
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("parts_test_" + std::to_string(getpid()));
  int written_ = 0;
};

TEST(Shards, TogetherDoEachItemOnceAndNearlyAlikeMany) {
  for (const int count : {1, 2, 3, 7}) {
    std::set<int> done;
    for (int index = 1; index <= count; ++index) {
      const std::vector<int> own = ItemsOf(Shard(index, count), 7);
      EXPECT_EQ(own.size(), static_cast<std::size_t>(
                                SizeOf(PartOf(Shard(index, count), "evaluate", 7, kMadeOf))));
      EXPECT_LE(own.size(), static_cast<std::size_t>(7 / count + 1));
      for (const int i : own) EXPECT_TRUE(done.insert(i).second) << i;
    }
    EXPECT_EQ(done.size(), 7U);
  }
  EXPECT_EQ(ItemsOf(cli::ShardOptions(), 3), (std::vector<int>{0, 1, 2}));
}

TEST(Shards, NoneIsWithoutWork) { EXPECT_THROW(ItemsOf(Shard(1, 8), 7), std::invalid_argument); }

TEST_F(Parts, AreJoinedInTheOrderOfItemsWhateverTheirOwn) {
  const std::string first = Write(1), second = Write(2), third = Write(3);
  const MergedRun run = ReadRecords({third, first, second});
  EXPECT_EQ(run.command, "evaluate");
  EXPECT_EQ(run.options, std::vector<std::string>{"--scenes=7"});
  ASSERT_EQ(run.parts.records.size(), 7U);
  for (int i = 0; i < 7; ++i)
    EXPECT_EQ(json::parse(run.parts.records[static_cast<std::size_t>(i)])["square"], i * i);
}

TEST_F(Parts, MissingAndDoubledOnesAreNamed) {
  const std::string first = Write(1), third = Write(3);
  EXPECT_EQ(Refusal([&] {
              ReadRecords({first, third});
            }),
            "part 2 of 3 is missing from the run of " + first);
  EXPECT_EQ(Refusal([&] {
              ReadRecords({first, third, third});
            }),
            third + ": is part 3 of 3, and so is " + third);
}

TEST_F(Parts, OfOtherRunsAreNamed) {
  const Part good = PartOf(Shard(2, 3), "evaluate", 7, kMadeOf);
  EXPECT_EQ(SaidOf(good), "");
  Part other = good;
  other.options = {"--scenes=8"};
  EXPECT_NE(SaidOf(other).find("other options: --scenes=8; not --scenes=7"), std::string::npos);
  other = good;
  other.made_of["world_version"] = "w2";
  EXPECT_NE(SaidOf(other).find("another world_version: \"w2\", not \"w1\""), std::string::npos);
  other = good;
  other.command = "oracle";
  EXPECT_NE(SaidOf(other).find("of oracle, not of evaluate"), std::string::npos);
  other = good;
  other.count = 4;
  EXPECT_NE(SaidOf(other).find("part 2 of 4, not of 3"), std::string::npos);
  other = good;
  other.version = "0.0.9";
  EXPECT_NE(SaidOf(other).find("was made by version 0.0.9"), std::string::npos);
}

TEST_F(Parts, DamagedFilesAndOthersAreNamed) {
  const std::string whole = Write(1, 1);
  EXPECT_EQ(Refusal([&] { ReadRecords({whole}); }), "");
  std::filesystem::resize_file(whole, std::filesystem::file_size(whole) / 2);
  EXPECT_EQ(Refusal([&] { ReadRecords({whole}); }).find(whole + ": is cut off or damaged"), 0U);
  EXPECT_EQ(Refusal([&] { ReadRecords({Path("none")}); }), Path("none") + ": cannot be read");
  std::ofstream(Path("report.json")) << R"({"scenes": 7})";
  EXPECT_NE(Refusal([&] { ReadRecords({Path("report.json")}); }).find("without --shard"),
            std::string::npos);
  WriteRecords(Path("few.json"), PartOf(Shard(1, 1), "evaluate", 7, kMadeOf), {json::object()});
  EXPECT_NE(Refusal([&] { ReadRecords({Path("few.json")}); }).find("does not hold its records"),
            std::string::npos);
}

TEST(RunItems, RunsItsShareAndWhatWasMergedNotAtAll) {
  const Items items = {"squares", 7, 2, kMadeOf};
  const auto work = [] { return [](int i) { return std::to_string(i * i); }; };
  EXPECT_EQ(RunItems(Shard(2, 3), items, work).records, (std::vector<json>{1, 16}));
  EXPECT_EQ(RunItems(Shard(2, 3), items, work).extent.wanted, 2);

  cli::ShardOptions merged;
  const std::vector<std::string> records = {"0", "1", "4", "9", "16", "25", "36"};
  merged.merged = std::make_shared<cli::MergedParts>(cli::MergedParts{kMadeOf.dump(), records});
  const auto no_work = []() -> std::function<std::string(int)> {
    throw std::logic_error("something is run");
  };
  EXPECT_EQ(RunItems(merged, items, no_work).records, RunItems({}, items, work).records);

  Items elsewhere = items;
  elsewhere.made_of = {{"world_version", "w2"}};
  EXPECT_NE(Refusal([&] { (void)RunItems(merged, elsewhere, no_work); }).find("world_version"),
            std::string::npos);
}

}  // namespace
}  // namespace prospect::tools

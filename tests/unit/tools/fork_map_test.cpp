#include "tools/common/fork_map.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <map>
#include <stdexcept>

namespace prospect::tools {
namespace {

std::map<int, std::string> Squares(int items, int jobs) {
  std::map<int, std::string> results;
  ForkMap(
      items, jobs, [] { return [](int i) { return "square " + std::to_string(i * i); }; },
      [&](int i, const std::string& line) {
        EXPECT_EQ(results.count(i), 0u) << "item " << i << " came twice";
        results[i] = line;
      });
  return results;
}

TEST(ForkMap, GivesTheSameResultsWhateverTheJobs) {
  const auto alone = Squares(17, 1);
  ASSERT_EQ(alone.size(), 17u);
  EXPECT_EQ(alone.at(4), "square 16");
  EXPECT_EQ(Squares(17, 2), alone);
  EXPECT_EQ(Squares(17, 5), alone);
}

TEST(ForkMap, MoreJobsThanItems) { EXPECT_EQ(Squares(2, 4).size(), 2u); }

TEST(ForkMap, CarriesLinesLongerThanAPipeHolds) {
  std::size_t length = 0;
  ForkMap(
      1, 2, [] { return [](int) { return std::string(300000, 'x'); }; },
      [&](int, const std::string& line) { length = line.size(); });
  EXPECT_EQ(length, 300000u);
}

TEST(ForkMap, ADeadChildIsAnError) {
  const auto run = [] {
    ForkMap(
        4, 2,
        [] {
          return [](int i) -> std::string {
            if (i == 3) _exit(9);
            return "fine";
          };
        },
        [](int, const std::string&) {});
  };
  EXPECT_THROW(run(), std::runtime_error);
}

TEST(ForkMap, AnExceptionInAChildIsAnError) {
  const auto run = [] {
    ForkMap(
        2, 2,
        [] { return [](int) -> std::string { throw std::runtime_error("expected by the test"); }; },
        [](int, const std::string&) {});
  };
  try {
    run();
    FAIL() << "expected an error";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "expected by the test");
  }
}

}  // namespace
}  // namespace prospect::tools

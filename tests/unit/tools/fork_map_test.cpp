#include "tools/common/fork_map.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <map>
#include <stdexcept>

#include "base/disk_error.h"

namespace prospect::tools {
namespace {

std::map<int, std::string> Squares(int items, int jobs) {
  std::map<int, std::string> results;
  const Extent extent = ForkMap(
      items, jobs, [] { return [](int i) { return "square " + std::to_string(i * i); }; },
      [&](int i, const std::string& line) {
        EXPECT_EQ(results.count(i), 0u) << "item " << i << " came twice";
        results[i] = line;
      });
  EXPECT_FALSE(extent.stopped());
  EXPECT_EQ(extent.done, items);
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
  const Extent extent = ForkMap(
      1, 2, [] { return [](int) { return std::string(300000, 'x'); }; },
      [&](int, const std::string& line) { length = line.size(); });
  EXPECT_EQ(length, 300000u);
  EXPECT_EQ(extent.done, 1);
}

TEST(ForkMap, ADeadChildIsAnError) {
  const auto run = [] {
    return ForkMap(
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

TEST(ForkMap, AFullDiskInAChildIsOne) {
  const auto run = [] {
    return ForkMap(
        2, 2, [] { return [](int) -> std::string { throw base::DiskError("full"); }; },
        [](int, const std::string&) {});
  };
  EXPECT_THROW(run(), base::DiskError);
}

// A program of its own, since the signal stays in force: item 5 never ends by itself. @return its
// exit code: how many items it got, or 99 for another fault
int StoppedAfter(int jobs, int signal) {
  const pid_t program = fork();
  if (program == 0) {
    int results = 0;
    const Extent extent = ForkMap(
        20, jobs,
        [signal, caller = getpid()] {
          return [signal, caller](int i) -> std::string {
            if (i == 5) kill(caller, signal);
            if (i == 5 && getpid() != caller) pause();
            return "";
          };
        },
        [&](int, const std::string&) { ++results; });
    _exit(extent.stopped() && extent.done == results && extent.wanted == 20 ? results : 99);
  }
  int status = 0;
  waitpid(program, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 99;
}

TEST(ForkMap, ASignalEndsItWithWhatIsDone) {
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EQ(StoppedAfter(1, signal), 6) << "the item at hand is finished";
    const int alone = StoppedAfter(2, signal);  // items 1 and 3, and whatever the other one got to
    EXPECT_GE(alone, 2);
    EXPECT_LE(alone, 12);
  }
}

TEST(Extent, IsToldAndWritten) {
  nlohmann::json report;
  const Extent all{5, 5}, some{3, 100};
  EXPECT_EQ(all.Line("scenes"), "");
  EXPECT_EQ(all.exit_code(), 0);
  EXPECT_EQ(some.Line("scenes"), "stopped after 3 of 100 scenes\n");
  EXPECT_EQ(some.exit_code(), 130);
  some.Put(&report);
  EXPECT_EQ(report, (nlohmann::json{{"stopped", true}, {"wanted", 100}}));
}

TEST(ForkMap, AnExceptionInAChildIsAnError) {
  const auto run = [] {
    return ForkMap(
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

#include "base/run_main.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "base/disk_error.h"
#include "base/lock.h"

namespace prospect {
namespace {

template <typename Error>
int CodeOf(const Error& error, ExitCode others = kExitUnexpected) {
  return RunMain([&error]() -> int { throw error; }, "run_main_test", others);
}

TEST(RunMain, EndsWithWhatTheBodyReturns) {
  EXPECT_EQ(RunMain([] { return 3; }), 3);
}

TEST(RunMain, AnErrorCarriesItsCode) {
  EXPECT_EQ(CodeOf(ExitError(kExitTimeout, "late")), 16);
  EXPECT_EQ(CodeOf(Interrupted("stopped after 3 of 9")), 130);
  EXPECT_EQ(CodeOf(base::DiskError("full")), 13);
  EXPECT_EQ(CodeOf(base::InUseError("used")), 13);
}

TEST(RunMain, UsageAndFileSystemHaveCodesEverywhere) {
  EXPECT_EQ(CodeOf(std::invalid_argument("no such task"), kExitWeights), 2);
  const std::filesystem::filesystem_error error("gone", std::error_code());
  EXPECT_EQ(CodeOf(error, kExitWeights), 13);
}

TEST(RunMain, OthersAreTheProgramsOwn) {
  EXPECT_EQ(CodeOf(std::runtime_error("else")), 1);
  EXPECT_EQ(CodeOf(std::runtime_error("else"), kExitWeights), 10);
}

// Scripts are written by that table.
TEST(ExitCodes, StandInTheTableOfTheDocs) {
  std::ifstream in(PROSPECT_ROOT "/docs/architecture.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  for (const int code : {kExitSuccess, kExitUnexpected, kExitUsage, kExitRefusal, kExitTaskFailure,
                         kExitTolerance, kExitWeights, kExitBus, kExitBusInUse, kExitDisk,
                         kExitDataFile, kExitServiceLost, kExitTimeout, kExitInterrupted}) {
    EXPECT_NE(page.find("| " + std::to_string(code) + " | "), std::string::npos) << code;
  }
}

TEST(RunMain, TellsBehindThePrefix) {
  testing::internal::CaptureStderr();
  CodeOf(ExitError(kExitBus, "no bus"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "run_main_test: no bus\n");
}

}  // namespace
}  // namespace prospect

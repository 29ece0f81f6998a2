#include "tools/dataset/sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::tools {
namespace {

// The trials' own pictures have no such dark letters on white.
int InkOf(const sim::Image& sheet, int top, int height) {
  const auto* begin = sheet.rgb.data() + static_cast<std::ptrdiff_t>(top) * sheet.width * 3;
  return static_cast<int>(std::count_if(begin, begin + std::ptrdiff_t{3} * height * sheet.width,
                                        [](std::uint8_t value) { return value < 128; }));
}

TEST(ContactSheet, HasATitleAndTheSeedOfEachRow) {
  const model::TestFolder folder;
  const auto sheet_of = [&](std::uint64_t trial) {
    const std::string path = folder / "trials.h5";
    model::WriteTrialFile(path, model::MadeTrial(trial, 2, false, 4, 128));
    return ContactSheet(model::TrialFile(path), nullptr, 1, 0);
  };
  const sim::Image sheet = sheet_of(1);
  EXPECT_GT(InkOf(sheet, 0, 18), 500) << "the title";
  EXPECT_GT(InkOf(sheet, 18, 18), 50) << "the line with the seed";
  EXPECT_GE(sheet.width, 3 * 128);
  const sim::Image other = sheet_of(888888);
  EXPECT_GT(InkOf(other, 18, 18), InkOf(sheet, 18, 18)) << "a longer seed, more ink";
}

TEST(ContactSheet, ALongTrialGoesOnBelow) {
  const model::TestFolder folder;
  const auto sheet_of = [&](int segments) {
    const std::string path = folder / "trials.h5";
    model::WriteTrialFile(path, model::MadeTrial(1, segments, false, 4, 128));
    return ContactSheet(model::TrialFile(path), nullptr, 1, 0);
  };
  const sim::Image brief = sheet_of(6);
  const sim::Image lengthy = sheet_of(20);
  EXPECT_LE(lengthy.width, 1900);
  EXPECT_GT(lengthy.height, brief.height + 128);
}

}  // namespace
}  // namespace prospect::tools

// A data set to robomimic's layout and back.
#include "tools/recordings/from_robomimic.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/atomic_file.h"
#include "model/dataset.h"
#include "model/hdf5_io.h"
#include "model/robomimic/export.h"
#include "tests/unit/model/test_folder.h"
#include "tests/unit/tools/recorded_trials.h"

namespace prospect::tools {
namespace {

class FromRobomimicTest : public ::testing::Test {
 protected:
  FromRobomimicTest() {
    for (const std::uint64_t seed : {3U, 4U, 17U, 23U}) {
      const std::string part = folder_ / std::to_string(seed) + ".h5";
      model::Trial trial = BinTrial(static_cast<std::uint64_t>(seed), seed == 4);
      if (seed == 17) trial.split = model::Split::kTest;
      model::WriteTrialFile(part, trial);
      parts_.push_back(part);
    }
    model::PackTrialFiles(parts_, folder_ / "set.h5");
    const model::TrialFile set(folder_ / "set.h5");
    model::robomimic::Export(set, folder_ / "r.hdf5", /*next_obs=*/true);
    base::WriteFile(folder_ / "r.csv", model::robomimic::SegmentTable(set));
    options_ = {folder_ / "r.hdf5", folder_ / "r.csv", "", folder_ / "back.h5", 1};
  }
  ConversionReport Convert(const tasks::TaskFile& task = BinTask()) {
    const auto say = [this](const std::string& line) { said_ += line + "\n"; };
    return FromRobomimic(task, options_, say, &stop_);
  }
  std::string WhyRefused() {
    try {
      Convert();
    } catch (const model::DataError& error) {
      return error.what();
    }
    return "not refused";
  }

  model::TestFolder folder_;
  std::vector<std::string> parts_;
  FromRobomimicOptions options_;
  std::atomic<bool> stop_{false};
  std::string said_;
};

TEST_F(FromRobomimicTest, WhatIsExportedComesBack) {
  const ConversionReport report = Convert();
  EXPECT_EQ(said_, "");
  EXPECT_EQ(report.trials, 4U);
  const model::TrialFile set(folder_ / "set.h5"), back(options_.out);
  ASSERT_EQ(back.seeds(), set.seeds());
  for (std::size_t i = 0; i < set.size(); ++i) {
    SCOPED_TRACE(set.seeds()[i]);
    const model::Trial before = set.Read(i), after = back.Read(i);
    ExpectSameLabels(after, before);
    EXPECT_EQ(after.images, before.images);
    EXPECT_EQ(back.part(i), set.part(i));
  }
}

TEST_F(FromRobomimicTest, AnExportIsNoDataSetOfOurs) {
  EXPECT_THROW(model::TrialFile(folder_ / "r.hdf5"), model::DataError);
}

TEST_F(FromRobomimicTest, PicturesOfAnotherSizeAreScaled) {
  tasks::TaskFile larger = BinTask();
  larger.spec.image_width = 96;
  larger.spec.image_height = 64;
  Convert(larger);
  EXPECT_EQ(said_, "pictures of 48x32 are scaled to the task's 96x64\n");
  const model::Trial trial = model::TrialFile(options_.out).Read(0);
  EXPECT_EQ(trial.width, 96);
  EXPECT_EQ(trial.frame(2)[2], 200) << "blue on the left";
  EXPECT_EQ(trial.frame(2)[95 * 3 + 2], 0) << "none on the right";
}

TEST_F(FromRobomimicTest, ACameraIsChosenByName) {
  options_.camera = "agentview_image";
  EXPECT_EQ(Convert().trials, 4U);
  options_.camera = "wrist";
  EXPECT_NE(WhyRefused().find("has no camera 'wrist'; choose one with --camera: agentview_image"),
            std::string::npos)
      << WhyRefused();
}

TEST_F(FromRobomimicTest, EveryFaultNamesFileAndLine) {
  std::ofstream(options_.segments) << "demo_3,1,4,open,1\ndemo_3,5,8,1,1\ndemo_4,1,4,open,1\n"
                                      "demo_17,5,40,1,0\n";
  const ConversionReport report = Convert();
  EXPECT_EQ(report.trials, 2U);
  EXPECT_EQ(report.repaired, 1U);
  EXPECT_EQ(report.left_out, 2U);
  for (const char* line : {"demo_4: left out: ", "r.csv: line 3: the last of 1 actions succeeded",
                           "demo_17: repaired: ", "goes 32 frames beyond the recording's 9",
                           "demo_23: left out: ", "r.csv: says nothing of it"}) {
    EXPECT_NE(said_.find(line), std::string::npos) << line << " is not in\n" << said_;
  }
  std::ofstream(options_.segments) << "demo_5,1,4,open,1\n";
  EXPECT_NE(WhyRefused().find("r.csv: line 1: there is no demonstration 'demo_5'"),
            std::string::npos);
}

TEST_F(FromRobomimicTest, WhatIsNoFileOfDemonstrationsIsNamed) {
  std::ofstream(options_.file) << "nothing";
  EXPECT_NE(WhyRefused().find("r.hdf5"), std::string::npos);
}

}  // namespace
}  // namespace prospect::tools

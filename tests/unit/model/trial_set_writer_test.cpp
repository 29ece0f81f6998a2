#include "model/trial_set_writer.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "model/dataset.h"
#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

namespace fs = std::filesystem;

class TrialSetWriterTest : public ::testing::Test {
 protected:
  static Trial Labels(const Trial& trial) {
    Trial labels = trial;
    labels.images.clear();
    return labels;
  }
  static void Write(const Trial& trial, TrialSetWriter* writer) {
    writer->Begin(trial, trial.frames());
    for (int i = 0; i < trial.frames(); ++i) writer->AddFrame(trial.frame(i));
    writer->End(Labels(trial));
  }
  std::size_t FilesLeft() const {
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_.path())) ++files;
    return files;
  }
  TestFolder folder_;
  const std::string path_ = folder_ / "set.h5";
};

TEST_F(TrialSetWriterTest, WhatIsWrittenAsAStreamReadsAsTrials) {
  Trial named = MadeTrial(7, 3);
  named.name = "Suturing_B001";
  {
    TrialSetWriter writer(path_);
    Write(MadeTrial(12), &writer);
    Write(named, &writer);
    EXPECT_EQ(writer.size(), 2U);
    EXPECT_FALSE(fs::exists(path_)) << "not before it is whole";
    writer.Commit({{7, Split::kTest}});
  }
  EXPECT_EQ(FilesLeft(), 1U);
  const TrialFile file(path_);
  ASSERT_EQ(file.seeds(), (std::vector<std::uint64_t>{7, 12}));
  const Trial back = file.Read(0);
  EXPECT_EQ(back.images, named.images);
  EXPECT_EQ(back.actions, named.actions);
  EXPECT_EQ(back.landmarks, named.landmarks);
  EXPECT_EQ(back.name, "Suturing_B001");
  EXPECT_EQ(file.Read(1).name, "");
  EXPECT_EQ(file.part(0), Split::kTest);
  EXPECT_EQ(back.part(), Split::kTest);
  EXPECT_EQ(file.part(1), SplitOf(12));
}

TEST_F(TrialSetWriterTest, PackingAndSummariesFollowTheMasks) {
  {
    TrialSetWriter writer(path_);
    for (std::uint64_t seed = 0; seed < 4; ++seed) Write(MadeTrial(seed), &writer);
    writer.Commit({{0, Split::kTrain}, {1, Split::kTest}, {2, Split::kValid}, {3, Split::kTest}});
  }
  const DataSetSummary summary = Summarize(TrialFile(path_));
  EXPECT_EQ(summary.train, 1U);
  EXPECT_EQ(summary.valid, 1U);
  EXPECT_EQ(summary.test, 2U);
  PackChoice choice;
  choice.split = Split::kTest;
  PackTrialFiles({path_}, folder_ / "test.h5", choice);
  const TrialFile packed(folder_ / "test.h5");
  EXPECT_EQ(packed.seeds(), (std::vector<std::uint64_t>{1, 3}));
  EXPECT_EQ(packed.part(0), Split::kTest);
  EXPECT_NE(packed.ContentHash(), TrialFile(path_).ContentHash());
}

TEST_F(TrialSetWriterTest, ADroppedTrialIsNotThere) {
  const Trial trial = MadeTrial(3);
  {
    TrialSetWriter writer(path_);
    writer.Drop();  // nothing was begun
    writer.Begin(trial, trial.frames());
    writer.AddFrame(trial.frame(0));
    writer.Drop();
    Write(MadeTrial(4), &writer);
    Write(trial, &writer);
    writer.Commit();
  }
  EXPECT_EQ(TrialFile(path_).Read(0).images, trial.images);
  EXPECT_EQ(TrialFile(path_).size(), 2U);
}

TEST_F(TrialSetWriterTest, NothingRemainsWithoutCommit) {
  {
    TrialSetWriter writer(path_);
    Write(MadeTrial(4), &writer);
    writer.Begin(MadeTrial(5), 10);
  }
  EXPECT_EQ(FilesLeft(), 0U);
  EXPECT_THROW(TrialSetWriter(path_).Commit(), DataError) << "no trial";
  EXPECT_EQ(FilesLeft(), 0U);
}

TEST_F(TrialSetWriterTest, TrialsThatBreakTheRulesAreRefused) {
  TrialSetWriter writer(path_);
  const Trial trial = MadeTrial(4);
  Write(trial, &writer);
  EXPECT_THROW(writer.Begin(trial, 1), DataError) << "twice";
  const Trial next = MadeTrial(5);
  writer.Begin(next, 1);
  writer.AddFrame(next.frame(0));
  EXPECT_THROW(writer.AddFrame(next.frame(1)), DataError) << "more than it was begun for";
  EXPECT_THROW(writer.End(Labels(next)), DataError) << "labels of more frames";
  writer.Drop();
  Trial other = MadeTrial(6);
  other.task = "another";
  EXPECT_THROW(Write(other, &writer), DataError);
}

TEST_F(TrialSetWriterTest, NoFolder) {
  EXPECT_THROW(TrialSetWriter(folder_ / "none/set.h5"), DiskError);
}

}  // namespace
}  // namespace prospect::model

#include "model/dataset.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>
#include <fstream>

#include "base/atomic_file.h"
#include "base/lock.h"
#include "model/hdf5_io.h"
#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

namespace fs = std::filesystem;

class DatasetTest : public ::testing::Test {
 protected:
  std::string Path(const std::string& name) const { return folder_ / name; }
  std::string Write(std::uint64_t seed, int segments = 2, bool fails = false) const {
    const std::string path = Path(std::to_string(seed) + ".h5");
    WriteTrialFile(path, MadeTrial(seed, segments, fails));
    return path;
  }
  TestFolder folder_;
};

void ExpectSame(const Trial& a, const Trial& b) {
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.task, b.task);
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_DOUBLE_EQ(a.tick_seconds, b.tick_seconds);
  EXPECT_DOUBLE_EQ(a.image_noise, b.image_noise);
  EXPECT_DOUBLE_EQ(a.light, b.light);
  EXPECT_EQ(a.actions, b.actions);
  EXPECT_EQ(a.prev_action, b.prev_action);
  EXPECT_EQ(a.segment, b.segment);
  EXPECT_EQ(a.rewards, b.rewards);
  EXPECT_EQ(a.dones, b.dones);
  EXPECT_EQ(a.present, b.present);
  EXPECT_EQ(a.num_actions, b.num_actions);
  EXPECT_EQ(a.successors, b.successors);
  EXPECT_EQ(a.plan_length, b.plan_length);
  EXPECT_EQ(a.world_version, b.world_version);
  EXPECT_EQ(a.task_hash, b.task_hash);
  EXPECT_EQ(a.segment_succeeded, b.segment_succeeded);
  EXPECT_EQ(a.num_landmarks, b.num_landmarks);
  EXPECT_EQ(a.landmarks, b.landmarks);
}

TEST_F(DatasetTest, ATrialComesBackAsItWas) {
  Trial trial = MadeTrial(7, 3, true);
  trial.image_noise = 0.01;
  trial.light = 0.93;
  trial.successors = {{1}, {0, 2}, {}, {0, 1, 2}};
  WriteTrialFile(Path("t.h5"), trial);
  const TrialFile file(Path("t.h5"));
  ASSERT_EQ(file.size(), 1U);
  const Trial back = file.Read(0);
  ExpectSame(back, trial);
  EXPECT_EQ(back.images, trial.images);
  EXPECT_TRUE(file.ReadLabels(0).images.empty());
}

TEST_F(DatasetTest, ATrialNeedNotSayWhereThingsAre) {
  Trial trial = MadeTrial(7);
  trial.num_landmarks = 0;
  trial.landmarks.clear();
  WriteTrialFile(Path("t.h5"), trial);
  ExpectSame(TrialFile(Path("t.h5")).Read(0), trial);
}

TEST_F(DatasetTest, ATrialWithoutAnActionIsKept) {
  Trial trial = MadeTrial(7, 0);
  WriteTrialFile(Path("t.h5"), trial);
  ExpectSame(TrialFile(Path("t.h5")).Read(0), trial);
}

TEST_F(DatasetTest, NoTemporaryFileIsLeft) {
  Write(3);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_.path())) ++files;
  EXPECT_EQ(files, 1U);
}

TEST_F(DatasetTest, AnUnwritableFolderIsAnErrorThatNamesTheFile) {
  try {
    WriteTrialFile(Path("absent/t.h5"), MadeTrial(1));
    FAIL() << "expected DiskError";
  } catch (const DiskError& error) {
    EXPECT_NE(std::string(error.what()).find("absent/t.h5"), std::string::npos) << error.what();
  }
}

TEST_F(DatasetTest, PackJoinsInTheOrderOfSeeds) {
  EXPECT_EQ(PackTrialFiles({Write(9, 3), Write(2), Write(5, 2, true)}, Path("all.h5")), 3U);
  const TrialFile file(Path("all.h5"));
  EXPECT_EQ(file.seeds(), (std::vector<std::uint64_t>{2, 5, 9}));
  const Trial nine = MadeTrial(9, 3);
  EXPECT_EQ(file.Read(2).images, nine.images);
  const DataSetSummary summary = Summarize(file);
  EXPECT_EQ(summary.trials, 3U);
  EXPECT_EQ(summary.successes, 2U);
  ASSERT_EQ(summary.failures.size(), 1U);
  EXPECT_EQ(summary.failures[0], (std::pair<std::string, std::size_t>{"time", 1}));
  EXPECT_EQ(summary.segments, 7U);
  EXPECT_EQ(summary.segments_succeeded, 6U);
  EXPECT_EQ(summary.train + summary.valid + summary.test, 3U);
}

TEST_F(DatasetTest, PackKeepsWhatMayFollow) {
  Trial trial = MadeTrial(3);
  trial.successors = {{1}, {2}, {0}, {0, 1, 2}};
  WriteTrialFile(Path("3.h5"), trial);
  PackTrialFiles({Path("3.h5")}, Path("all.h5"));
  EXPECT_EQ(TrialFile(Path("all.h5")).ReadLabels(0).successors, trial.successors);
}

TEST_F(DatasetTest, APackedFileCanBePackedAgain) {
  PackTrialFiles({Write(1), Write(2)}, Path("a.h5"));
  EXPECT_EQ(PackTrialFiles({Path("a.h5"), Write(3)}, Path("b.h5")), 3U);
  EXPECT_EQ(TrialFile(Path("b.h5")).Read(1).images, MadeTrial(2).images);
}

TEST_F(DatasetTest, PackTakesTheFirstTrialsOfOnePart) {
  std::vector<std::string> parts;
  std::vector<std::uint64_t> held_out;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    parts.push_back(Write(seed));
    if (SplitOf(seed) == Split::kTest) held_out.push_back(seed);
  }
  ASSERT_GT(held_out.size(), 2U);
  PackTrialFiles(parts, Path("all.h5"));
  PackChoice choice;
  choice.split = Split::kTest;
  EXPECT_EQ(PackTrialFiles({Path("all.h5")}, Path("test.h5"), choice), held_out.size());
  EXPECT_EQ(TrialFile(Path("test.h5")).seeds(), held_out);
  choice.most = 2;
  EXPECT_EQ(PackTrialFiles({Path("all.h5")}, Path("two.h5"), choice), 2U);
  held_out.resize(2);
  EXPECT_EQ(TrialFile(Path("two.h5")).seeds(), held_out);
  EXPECT_LT(fs::file_size(Path("two.h5")), fs::file_size(Path("all.h5")) / 4);
}

TEST_F(DatasetTest, PackRefusesToWriteNoTrials) {
  std::uint64_t seed = 0;
  while (SplitOf(seed) == Split::kTest) ++seed;
  PackChoice choice;
  choice.split = Split::kTest;
  EXPECT_THROW(PackTrialFiles({Write(seed)}, Path("none.h5"), choice), DataError);
  EXPECT_FALSE(fs::exists(Path("none.h5")));
}

TEST_F(DatasetTest, PackRefusesTheSameSeedTwice) {
  const std::string one = Write(4);
  fs::copy_file(one, Path("copy.h5"));
  EXPECT_THROW(PackTrialFiles({one, Path("copy.h5")}, Path("all.h5")), DataError);
  EXPECT_FALSE(fs::exists(Path("all.h5")));
}

TEST_F(DatasetTest, PackRefusesAnotherImageSize) {
  WriteTrialFile(Path("big.h5"), MadeTrial(8, 2, false, 4, 16));
  EXPECT_THROW(PackTrialFiles({Write(4), Path("big.h5")}, Path("all.h5")), DataError);
}

TEST_F(DatasetTest, ChosenFramesAreThoseOfTheTrial) {
  const TrialFile file(Write(6));
  const Trial trial = MadeTrial(6);
  std::vector<std::uint8_t> frames(2 * trial.frame_bytes());
  file.ReadFrames(0, {8, 1}, frames.data());
  EXPECT_EQ(std::vector<std::uint8_t>(frames.begin(), frames.begin() + trial.frame_bytes()),
            std::vector<std::uint8_t>(trial.frame(8), trial.frame(8) + trial.frame_bytes()));
  EXPECT_THROW(file.ReadFrames(0, {9}, frames.data()), DataError);
  EXPECT_THROW(file.ReadFrames(0, {-1}, frames.data()), DataError);
}

TEST_F(DatasetTest, ATruncatedFileIsRefusedByName) {
  const std::string path = Write(4);
  fs::resize_file(path, fs::file_size(path) / 2);
  EXPECT_FALSE(IsWholeTrialFile(path));
  try {
    const TrialFile file(path);
    file.Read(0);
    FAIL() << "expected DataError";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("4.h5"), std::string::npos);
  }
}

// Puts an empty data set of `rows` rows in the place of one of a trial's.
void Lengthen(const std::string& path, const std::string& name, hsize_t rows) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(H5Ldelete(file, name.c_str(), H5P_DEFAULT), 0);
  const hid_t space = H5Screate_simple(1, &rows, nullptr);
  const hid_t set = H5Dcreate2(file, name.c_str(), H5T_NATIVE_UINT8, space, H5P_DEFAULT,
                               H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(set, 0);
  H5Dclose(set);
  H5Sclose(space);
  H5Fclose(file);
}

TEST_F(DatasetTest, ADamagedLengthTakesNoGigabytes) {
  const std::string path = Write(4);
  Lengthen(path, "data/demo_4/dones", hsize_t{1} << 32);
  try {
    TrialFile(path).Read(0);
    FAIL() << "expected DataError";
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("'dones' is too long"), std::string::npos)
        << error.what();
  }
}

TEST_F(DatasetTest, AFileThatIsNotOursIsRefused) {
  std::ofstream(Path("text.h5")) << "not a data set";
  EXPECT_THROW(TrialFile(Path("text.h5")), DataError);
  EXPECT_THROW(TrialFile(Path("none.h5")), DataError);
  EXPECT_FALSE(IsWholeTrialFile(Path("none.h5")));
}

std::string WhyRefused(const std::string& path) {
  try {
    const TrialFile file(path);
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

// As robomimic's own: data/demo_N with obs/KEY, actions, no labels of ours.
void WriteRobomimic(const std::string& path, bool pictures) {
  const hdf5::Handle file = hdf5::CreateFile(path);
  const hdf5::Handle data = hdf5::CreateGroup(file, "data", path);
  hdf5::SetInteger(data, "total", 4, path);
  for (const char* name : {"demo_0", "demo_1"}) {
    const hdf5::Handle demo = hdf5::CreateGroup(data, name, path);
    hdf5::SetInteger(demo, "num_samples", 2, path);
    hdf5::Write<float>(demo, "actions", std::vector<float>(14), {2, 7}, path);
    const hdf5::Handle obs = hdf5::CreateGroup(demo, "obs", path);
    hdf5::Write<float>(obs, "robot0_eef_pos", std::vector<float>(6), {2, 3}, path);
    if (!pictures) continue;
    for (const char* camera : {"agentview_image", "robot0_eye_in_hand_image"})
      hdf5::Write<std::uint8_t>(obs, camera, std::vector<std::uint8_t>(2 * 4 * 6 * 3), {2, 4, 6, 3},
                                path);
  }
}

TEST_F(DatasetTest, DemonstrationsOfRobomimicAreNamedAsSuch) {
  WriteRobomimic(Path("r.h5"), true);
  const std::string why = WhyRefused(Path("r.h5"));
  EXPECT_NE(
      why.find("holds 2 demonstrations in robomimic's layout, with the camera agentview_image "
               "6x4, robot0_eye_in_hand_image 6x4"),
      std::string::npos)
      << why;
  EXPECT_NE(why.find("dataset from-robomimic"), std::string::npos);
  WriteRobomimic(Path("low.h5"), false);
  EXPECT_NE(WhyRefused(Path("low.h5")).find("without pictures of a camera"), std::string::npos);
  EXPECT_THROW(PackTrialFiles({Path("r.h5")}, Path("out.h5")), DataError);
}

TEST_F(DatasetTest, OfOtherHdf5FilesItIsSaidWhatTheyHold) {
  {
    const hdf5::Handle file = hdf5::CreateFile(Path("o.h5"));
    for (const char* name : {"action", "observations", "bad\nname"})
      hdf5::CreateGroup(file, name, Path("o.h5"));
  }
  const std::string why = WhyRefused(Path("o.h5"));
  EXPECT_NE(why.find("it holds 'action', 'bad?name', 'observations', and no group 'data'"),
            std::string::npos)
      << why;
}

TEST_F(DatasetTest, TwoProcessesDoNotPackIntoOneFile) {
  const std::string part = Write(7);
  const base::AtomicFile other(Path("out.h5"));
  EXPECT_THROW(PackTrialFiles({part}, Path("out.h5")), base::InUseError);
  EXPECT_FALSE(fs::exists(Path("out.h5")));
}

TEST_F(DatasetTest, NumbersOfARobotsTrialsAreNoSeeds) {
  Trial trial = MadeTrial(1'500'000);
  EXPECT_THROW(WriteTrialFile(Path("t.h5"), trial), DataError) << "kept for calibration";
  trial.simulated = false;
  WriteTrialFile(Path("t.h5"), trial);
  EXPECT_EQ(PackTrialFiles({Path("t.h5"), Write(7)}, Path("out.h5")), 2U);
  const TrialFile packed(Path("out.h5"));
  EXPECT_TRUE(packed.ReadLabels(0).simulated);
  EXPECT_FALSE(packed.ReadLabels(1).simulated);
  EXPECT_EQ(packed.seeds()[1], 1'500'000U);
  trial.seed = 1'000'000'000;
  EXPECT_THROW(WriteTrialFile(Path("t.h5"), trial), DataError);
}

TEST_F(DatasetTest, FlippedBytesNeverCrashTheReader) {
  const std::string path = Write(4);
  std::ifstream in(path, std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(in)), {});
  for (std::size_t at = 0; at < good.size(); at += 97) {
    std::string bad = good;
    bad[at] = static_cast<char>(~bad[at]);
    std::ofstream(Path("bad.h5"), std::ios::binary) << bad;
    try {
      const Trial trial = TrialFile(Path("bad.h5")).Read(0);
      EXPECT_EQ(trial.frames(), 9);  // damage inside pixels or texts cannot be seen, the shape can
    } catch (const DataError&) {
    }
  }
}

// Caches are kept by it: pictures of one file must never stand in for those of another.
TEST_F(DatasetTest, ThePicturesHashFollowsPixels) {
  Trial trial = MadeTrial(7);
  WriteTrialFile(Path("a.h5"), trial);
  trial.images[5] ^= 1;
  WriteTrialFile(Path("b.h5"), trial);
  const TrialFile a(Path("a.h5")), b(Path("b.h5"));
  EXPECT_EQ(a.ContentHash(), b.ContentHash());
  EXPECT_NE(a.PicturesHash(), b.PicturesHash());
  EXPECT_EQ(a.PicturesHash(), TrialFile(Path("a.h5")).PicturesHash());
}

TEST_F(DatasetTest, TheContentHashFollowsLabels) {
  const std::string a = TrialFile(Write(4)).ContentHash();
  EXPECT_EQ(a, TrialFile(Write(4)).ContentHash());
  EXPECT_NE(a, TrialFile(Write(4, 2, true)).ContentHash());
  EXPECT_NE(a, TrialFile(Write(5)).ContentHash());
}

TEST(ValidateTrial, RefusesWhatBreaksTheRules) {
  const auto refused = [](const auto& change) {
    Trial trial = MadeTrial(1);
    change(&trial);
    EXPECT_THROW(ValidateTrial(trial), DataError);
  };
  EXPECT_NO_THROW(ValidateTrial(MadeTrial(999'999)));
  refused([](Trial* t) { t->seed = 1'000'000; });
  refused([](Trial* t) { t->outcome = "maybe"; });
  refused([](Trial* t) { t->images.pop_back(); });
  refused([](Trial* t) { t->actions[3] = 9; });
  refused([](Trial* t) { t->actions[0] = 1; });
  refused([](Trial* t) { t->segment[4] = 5; });
  refused([](Trial* t) { t->segment_succeeded.pop_back(); });
  refused([](Trial* t) { t->present.pop_back(); });
  refused([](Trial* t) { t->successors = {{0}, {1}, {2}}; });
  refused([](Trial* t) { t->successors = {{0}, {1}, {2}, {3}}; });
}

TEST(Split, IsFrozen) {
  // Changing these values would move trials between training and test sets.
  std::string splits;
  for (std::uint64_t seed = 0; seed < 40; ++seed) splits += SplitName(SplitOf(seed))[1];
  EXPECT_EQ(splits, "rraererrrrrrrarrrrrrrrrrraerrrrrrrrrrrrr");
}

TEST(Split, HasATenthEach) {
  int counts[3] = {0, 0, 0};
  for (std::uint64_t seed = 0; seed < 100'000; ++seed) ++counts[static_cast<int>(SplitOf(seed))];
  EXPECT_NEAR(counts[static_cast<int>(Split::kTest)], 10'000, 400);
  EXPECT_NEAR(counts[static_cast<int>(Split::kValid)], 10'000, 400);
}

}  // namespace
}  // namespace prospect::model

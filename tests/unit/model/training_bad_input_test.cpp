// What training says of data, weights and checkpoints that it cannot use, and that it harms
// nothing.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "model/dataset.h"
#include "model/training/export.h"
#include "model/training/scores.h"
#include "model/training/stage.h"
#include "model/training/trainer.h"
#include "model/weights_error.h"
#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

namespace fs = std::filesystem;

constexpr int kTrials = 30;  // enough that every part has some
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TrainConfig FewSteps() {
  TrainConfig config;
  config.network.image_width = config.network.image_height = 32;
  config.network.num_actions = 3;
  config.mids_per_segment = 1;
  config.landmark_weight = 1.0;
  for (StageConfig* stage : {&config.classifier, &config.encoder_decoder, &config.transform_hidden,
                             &config.transform_image, &config.heads}) {
    *stage = {2, 2, 1e-3};
  }
  return config;
}

std::string WhyRefused(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "it was not";
}

void ExpectTells(const std::string& said, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(said.find(part), std::string::npos) << "no '" << part << "' in: " << said;
  }
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
}

std::string Bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(in)), {});
}

/// Every file under a folder with what it holds.
std::map<std::string, std::string> FilesUnder(const fs::path& folder) {
  std::map<std::string, std::string> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = Bytes(entry.path());
  }
  return files;
}

Trial SmallTrial(std::uint64_t seed, bool fails) { return MadeTrial(seed, 2, fails, 6, 32); }

class TrainingBadInput : public ::testing::Test {
 protected:
  /// A data set of trials 0 to 29, of which every third fails, or all.
  std::string WriteData(const std::string& name, bool all_fail = false) const {
    std::vector<std::string> parts;
    for (int seed = 0; seed < kTrials; ++seed) {
      parts.push_back(folder_ / (name + std::to_string(seed)));
      WriteTrialFile(parts.back(),
                     SmallTrial(static_cast<std::uint64_t>(seed), all_fail || seed % 3 == 0));
    }
    PackTrialFiles(parts, folder_ / name);
    return folder_ / name;
  }
  TrainOptions Options(const std::string& data, const std::string& out) const {
    TrainOptions options;
    options.task = "made";
    options.data = data;
    options.folder = folder_ / out;
    return options;
  }
  TestFolder folder_;
};

TEST_F(TrainingBadInput, ADataSetOfAnotherTaskOrShape) {
  TrainOptions options = Options(WriteData("made.h5"), "run");
  options.task = "stacking";
  const auto train = [&](const TrainConfig& config) { Trainer(config, options).Run(); };
  EXPECT_THROW(train(FewSteps()), DataError);
  ExpectTells(WhyRefused([&] { train(FewSteps()); }),
              {"made.h5", "holds trials of 'made', not of 'stacking'"});
  options.task = "made";
  TrainConfig config = FewSteps();
  config.network.image_width = config.network.image_height = 64;
  EXPECT_THROW(train(config), DataError);
  ExpectTells(WhyRefused([&] { train(config); }), {"made.h5", "picture size"});
  EXPECT_TRUE(FilesUnder(folder_ / "run").empty());
}

TEST_F(TrainingBadInput, NoSuccessIsSaidBeforeAnythingIsTrained) {
  TrainOptions options = Options(WriteData("failures.h5", /*all_fail=*/true), "run");
  const auto train = [&] { Trainer(FewSteps(), options).Run(); };
  EXPECT_THROW(train(), DataError);
  ExpectTells(WhyRefused(train), {"failures.h5", "succeeded", "add trials that succeed"});
  EXPECT_TRUE(FilesUnder(folder_ / "run").empty()) << "not even the pictures were read";
  options.stages = {"heads"};
  EXPECT_THROW(train(), DataError);
  options.stages = {"encoder-decoder"};
  EXPECT_NO_THROW(train()) << "which looks at pictures only";
}

TEST_F(TrainingBadInput, TrialsWithNumbersThatAreNoneAreNotWritten) {
  const std::vector<std::pair<std::string, std::function<void(Trial*)>>> faults = {
      {"reward", [](Trial* t) { t->rewards[1] = kNaN; }},
      {"reward", [](Trial* t) { t->rewards[1] = kInfinity; }},
      {"landmark", [](Trial* t) { t->landmarks[2] = kNaN; }},
      {"landmark", [](Trial* t) { t->landmarks[3] = kNaN; }},
      {"landmark", [](Trial* t) { t->landmarks[2] = t->landmarks[3] = kInfinity; }},
      {"tick_seconds", [](Trial* t) { t->tick_seconds = 0; }},
      {"tick_seconds", [](Trial* t) { t->tick_seconds = kNaN; }},
      {"image_noise", [](Trial* t) { t->image_noise = kNaN; }},
      {"light", [](Trial* t) { t->light = kInfinity; }}};
  for (const auto& [what, damage] : faults) {
    Trial trial = SmallTrial(7, false);
    damage(&trial);
    EXPECT_THROW(WriteTrialFile(folder_ / "trial.h5", trial), DataError) << what;
    ExpectTells(WhyRefused([&, &t = trial] { WriteTrialFile(folder_ / "trial.h5", t); }),
                {"seed 7", what});
  }
  Trial trial = SmallTrial(7, false);
  trial.landmarks[2] = trial.landmarks[3] = kNaN;  // an object that is not there
  EXPECT_NO_THROW(WriteTrialFile(folder_ / "trial.h5", trial));
}

/// A data set opened by libhdf5 itself, to damage it.
class OpenedFile {
 public:
  OpenedFile(const std::string& path, const std::string& dataset)
      : file_(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)),
        set_(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT)) {
    EXPECT_GE(set_, 0) << dataset;
  }
  ~OpenedFile() {
    H5Dclose(set_);
    H5Fclose(file_);
  }
  OpenedFile(const OpenedFile&) = delete;
  OpenedFile& operator=(const OpenedFile&) = delete;
  hid_t file() const { return file_; }
  hid_t set() const { return set_; }

 private:
  hid_t file_, set_;
};

TEST_F(TrainingBadInput, NumbersThatAreNoneInAFile) {
  for (const std::string name : {"rewards", "obs/landmarks"}) {
    const std::string data = WriteData("numbers.h5");
    {
      const OpenedFile opened(data, "data/demo_4/" + name);
      std::vector<float> values(name == "rewards" ? 13 : 26, 0.5F);
      values[5] = kNaN;
      ASSERT_GE(
          H5Dwrite(opened.set(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          0);
    }
    const auto train = [&] { Trainer(FewSteps(), Options(data, "run")).Run(); };
    EXPECT_THROW(train(), DataError);
    ExpectTells(WhyRefused(train),
                {"numbers.h5", "seed 4", name == "rewards" ? "reward" : "landm"});
  }
}

struct Chunk {
  haddr_t at = 0;
  hsize_t bytes = 0;
};

Chunk ChunkOfFrame(hid_t images, hsize_t frame) {
  const hsize_t offset[4] = {frame, 0, 0, 0};
  unsigned mask = 0;
  Chunk chunk;
  EXPECT_GE(H5Dget_chunk_info_by_coord(images, offset, &mask, &chunk.at, &chunk.bytes), 0);
  EXPECT_GT(chunk.bytes, 20u);
  return chunk;
}

void FlipBytes(const std::string& path) {
  Chunk chunk;
  {
    const OpenedFile opened(path, "data/demo_4/obs/agentview_image");
    chunk = ChunkOfFrame(opened.set(), 7);
  }
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(static_cast<std::streamoff>(chunk.at + chunk.bytes / 2));
  const char byte = static_cast<char>(file.get() ^ 0x55);
  file.seekp(static_cast<std::streamoff>(chunk.at + chunk.bytes / 2));
  file.put(byte);
}

void CutChunk(const std::string& path) {
  const OpenedFile opened(path, "data/demo_4/obs/agentview_image");
  const hsize_t offset[4] = {7, 0, 0, 0};
  std::vector<char> bytes(ChunkOfFrame(opened.set(), 7).bytes);
  std::uint32_t mask = 0;
  ASSERT_GE(H5Dread_chunk(opened.set(), H5P_DEFAULT, offset, &mask, bytes.data()), 0);
  ASSERT_GE(H5Dwrite_chunk(opened.set(), H5P_DEFAULT, 0, offset, bytes.size() / 2, bytes.data()),
            0);
}

/// Pictures of 64x64 where the labels say 32x32.
void GrowPictures(const std::string& path) {
  const std::string name = "data/demo_4/obs/agentview_image";
  const OpenedFile opened(path, name);
  ASSERT_GE(H5Ldelete(opened.file(), name.c_str(), H5P_DEFAULT), 0);
  const hsize_t dims[4] = {13, 64, 64, 3};
  const hid_t space = H5Screate_simple(4, dims, nullptr);
  const hid_t set = H5Dcreate2(opened.file(), name.c_str(), H5T_NATIVE_UINT8, space, H5P_DEFAULT,
                               H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(set, 0);
  H5Dclose(set);
  H5Sclose(space);
}

// Frame 7 ends the first action, so training reads it.
TEST_F(TrainingBadInput, DamagedFramesAreNamedAndHarmNothing) {
  const std::vector<std::pair<std::string, void (*)(const std::string&)>> damages = {
      {"frame 7 cannot be read", FlipBytes},
      {"frame 7 cannot be read", CutChunk},
      {"another shape", GrowPictures}};
  const std::string data = WriteData("frames.h5");
  TrainOptions options = Options(data, "run");
  options.stages = {"classifier"};
  Trainer(FewSteps(), options).Run();
  const auto trained = FilesUnder(folder_ / "run/stages");
  ASSERT_FALSE(trained.empty());
  fs::copy_file(data, folder_ / "sound.h5");
  for (const auto& [said, damage] : damages) {
    fs::copy_file(folder_ / "sound.h5", data, fs::copy_options::overwrite_existing);
    damage(data);
    fs::remove_all(folder_ / "run/cache");
    const auto train = [&] { Trainer(FewSteps(), options).Run(); };
    EXPECT_THROW(train(), DataError) << said;
    ExpectTells(WhyRefused(train), {"frames.h5", "trial of seed 4", said, "damaged"});
    EXPECT_TRUE(FilesUnder(folder_ / "run/cache").empty()) << "no half cache of pictures";
    EXPECT_EQ(FilesUnder(folder_ / "run/stages"), trained);
  }
}

/// The parameters of all networks, end to end.
torch::Tensor AllWeights(const Trainer& trainer) {
  std::vector<torch::Tensor> all;
  for (const auto& [name, module] : trainer.context().networks.named()) {
    for (const torch::Tensor& tensor : module->parameters())
      all.push_back(tensor.detach().flatten().clone());
  }
  return torch::cat(all);
}

TEST_F(TrainingBadInput, WeightsToBeginFromMustFit) {
  const std::string data = WriteData("made.h5");
  Trainer first(FewSteps(), Options(data, "first"));
  first.Run();
  const std::string weights = ExportWeights(first, {{"plan", {{"threshold", 0.5}}}});
  TrainOptions options = Options(data, "next");
  options.from = weights;

  std::vector<std::pair<std::string, TrainConfig>> others(4, {"", FewSteps()});
  others[0].first = "tensor 'encoder.layers.7.conv.weight' has another shape";
  others[0].second.network.hidden_channels = 4;
  others[1].first = "tensor 'q.from_h.conv.weight' has another shape";
  others[1].second.network.heads = "costar";
  others[2].first = "no tensor 'transform.strided.conv.";
  others[2].second.network.bottleneck = "strided";
  others[3].first = "tensor 'transform.dense.weight' has another shape";
  others[3].second.network.image_width = others[3].second.network.image_height = 64;
  for (const auto& [said, config] : others) {
    const auto train = [&, &c = config] { Trainer(c, options).Run(); };
    EXPECT_THROW(train(), WeightsError) << said;
    ExpectTells(WhyRefused(train), {".safetensors", said});
  }
  EXPECT_TRUE(FilesUnder(folder_ / "next").empty()) << "nothing was trained before it was said";

  TrainConfig no_steps = FewSteps();
  for (StageConfig* stage :
       {&no_steps.classifier, &no_steps.encoder_decoder, &no_steps.transform_hidden,
        &no_steps.transform_image, &no_steps.heads}) {
    stage->iterations = 0;
  }
  Trainer same(no_steps, options);
  same.Run();
  RoundToHalf(first.context().networks);
  EXPECT_TRUE(AllWeights(same).equal(AllWeights(first))) << "those that fit are begun from";
  fs::remove(ClassifiersPath(weights));
  const auto train = [&] { Trainer(FewSteps(), options).Run(); };
  EXPECT_THROW(train(), WeightsError);
  ExpectTells(WhyRefused(train), {"made-classifiers.safetensors", "cannot be opened"});
}

TEST_F(TrainingBadInput, CheckpointsOfAnotherConfigurationAreLeftAlone) {
  const std::string data = WriteData("made.h5");
  TrainConfig other = FewSteps();
  other.network.dropout = 0.3;
  TrainOptions options = Options(data, "run");
  options.stages = {"classifier"};
  Trainer(FewSteps(), options).Run();
  const auto before = FilesUnder(folder_ / "run/stages");
  ASSERT_EQ(before.size(), 2u);  // the stage and its curves

  Trainer beside(other, options);
  beside.Run();
  const auto after = FilesUnder(folder_ / "run/stages");
  EXPECT_EQ(after.size(), 2 * before.size());
  for (const auto& [name, bytes] : before) EXPECT_EQ(after.at(name), bytes) << name;

  // Even under the very names that this configuration looks for, they are not taken for its own.
  TrainOptions mixed = Options(data, "mixed");
  mixed.stages = {"classifier"};
  std::string stage_of_other;
  for (const auto& [name, bytes] : after) {
    if (!before.contains(name) && fs::path(name).extension() == ".pt") stage_of_other = name;
  }
  const fs::path target = fs::path(folder_ / "mixed/stages") / stage_of_other;
  fs::create_directories(target.parent_path());
  for (const auto& [name, bytes] : before) {
    if (fs::path(name).extension() != ".pt") continue;
    std::ofstream(target, std::ios::binary) << bytes;
    std::ofstream(fs::path(target).replace_extension(".checkpoint"), std::ios::binary) << bytes;
  }
  Trainer anew(other, mixed);
  anew.Run();
  EXPECT_TRUE(AllWeights(anew).equal(AllWeights(beside)));
}

/// A stage whose loss is no number from the second step on.
class DivergingStage : public Stage {
 public:
  std::string name() const override { return "diverging"; }
  const StageConfig& config() const override { return config_; }
  std::vector<std::pair<std::string, torch::nn::Module*>> modules() const override {
    return {{"layer", layer_.ptr().get()}};
  }
  LossParts Loss(std::int64_t iteration, int /*shard*/, int /*shards*/) override {
    torch::nn::Linear layer = layer_;
    const torch::Tensor loss = layer->forward(torch::ones({1, 1})).sum() / (iteration < 1 ? 1 : 0);
    return {loss, {{"l1", loss.item<double>()}}};
  }

 private:
  StageConfig config_{5, 1, 1e-3};
  torch::nn::Linear layer_{1, 1};
};

TEST_F(TrainingBadInput, ALossThatIsNoNumberEndsTheStage) {
  DivergingStage stage;
  StageRun run;
  run.folder = folder_ / "run";
  run.key = "key";
  const auto train = [&] { RunStage(&stage, run); };
  EXPECT_THROW(train(), ExitError);
  ExpectTells(WhyRefused(train),
              {"stage diverging", "'l1' is no longer a number", "learning_rate"});
}

TEST_F(TrainingBadInput, CudaThatIsNotThereIsSaidAtOnce) {
  if (torch::cuda::is_available()) GTEST_SKIP() << "there is a GPU";
  TrainOptions options = Options(folder_ / "no data are needed for that", "run");
  options.device = "cuda";
  const auto train = [&] { Trainer(FewSteps(), options).Run(); };
  EXPECT_THROW(train(), std::invalid_argument);
  ExpectTells(WhyRefused(train), {"device 'cuda'", "--device cpu"});
}

}  // namespace
}  // namespace prospect::model

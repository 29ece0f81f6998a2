// The suturing weights that the repository holds, measured again on its held-out simulated trials.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "model/dataset.h"
#include "model/engine.h"
#include "model/training/export.h"
#include "model/training/scores.h"
#include "model/training/trainer.h"
#include "model/weights.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kRoot = PROSPECT_ROOT;
const std::string kWeights = kRoot + "/model/weights/suturing.safetensors";
const std::string kTrials = kRoot + "/model/held_out/suturing.h5";

TEST(BundledGestures, AreSmallAndPredictPicturesOnly) {
  EXPECT_LE(fs::file_size(kWeights), 12'000'000U);
  EXPECT_FALSE(fs::exists(ClassifiersPath(kWeights)));
  const json metadata = ReadWeights(kWeights).metadata;
  EXPECT_EQ(metadata["task"], "suturing");
  EXPECT_EQ(metadata["command"].get<std::string>().rfind("./prospect train --task suturing", 0), 0U)
      << metadata["command"];
  const auto engine = LoadEngine(kWeights, 1);
  EXPECT_FALSE(engine->info().judges);
  EXPECT_EQ(engine->info().num_actions, 15);
  EXPECT_EQ(engine->info().image_width, 128);
  EXPECT_EQ(engine->info().image_height, 96);
  EXPECT_EQ(engine->info().hidden_size, 12 * 16 * 8);
}

TEST(BundledGestures, ReachThePapersFiguresOnTrialsNotTrainedOn) {
  const TrialFile file(kTrials);
  for (std::size_t i = 0; i < file.size(); ++i) EXPECT_EQ(file.part(i), Split::kTest);
  const TestFolder folder;
  TrainOptions options;
  options.task = "suturing";
  options.data = kTrials;
  options.folder = folder / "scores";
  options.score_only = true;
  const json metadata = ReadWeights(kWeights).metadata;
  Trainer trainer(metadata["train"].get<TrainConfig>(), options);
  trainer.Load(kWeights);
  const json scores = ComputeScores(trainer.context(), trainer.file(), options.threads);
  const json &x1 = scores["pictures"]["x1"], &x2 = scores["pictures"]["x2"];
  EXPECT_LE(x1["mae"].get<double>(), 0.039);
  EXPECT_LE(x2["mae"].get<double>(), 0.062);
  EXPECT_LT(x1["mae"].get<double>(), 0.9 * x1["copy_mae"].get<double>());
  EXPECT_LT(x2["mae"].get<double>(), 0.9 * x2["copy_mae"].get<double>());
  EXPECT_GT(x1["ssim"].get<double>(), x1["copy_ssim"].get<double>());
}

double MeanDifference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / 255 / static_cast<double>(a.size());
}

// The original fed the first gesture twice.
TEST(BundledGestures, TheSecondPictureFollowsTheSecondGesture) {
  const auto engine = LoadEngine(kWeights, 1);
  const TrialFile file(kTrials);
  const Trial trial = file.Read(0);
  const Pixels seen(trial.frame(0), trial.frame_bytes());
  const Hidden h0 = engine->Encode(seen);
  const Hidden h1 = engine->Expand({{h0, h0, 0}}).front().h;
  const auto after = [&](int second) {
    const Hidden h2 = engine->Expand({{h0, h1, second}}).front().h;
    return engine->DecodeOnto(seen, h0, {h2}).front();
  };
  const int position = 1, pull = 5, orient = 7;  // G2, G6, G8
  EXPECT_EQ(after(position), after(position));
  EXPECT_GT(MeanDifference(after(position), after(pull)), 0.003);
  EXPECT_GT(MeanDifference(after(orient), after(pull)), 0.003);
}

}  // namespace
}  // namespace prospect::model

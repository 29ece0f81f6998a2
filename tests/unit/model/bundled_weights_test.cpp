// The weights that the repository holds, measured again on its held-out trials.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "model/calibration.h"
#include "model/dataset.h"
#include "model/novelty.h"
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
const std::string kWeights = kRoot + "/model/weights/stacking.safetensors";
const std::string kTrials = kRoot + "/model/held_out/stacking.h5";
const std::string kScores = kRoot + "/model/held_out/stacking-scores.json";
// What another processor's rounding may change: a share of an error, a few of some hundred answers.
constexpr double kErrorShare = 0.01, kAnswers = 0.02;

TEST(BundledWeights, SayHowTheyWereMade) {
  const json metadata = ReadWeights(kWeights).metadata;
  EXPECT_EQ(metadata["task"], "stacking");
  EXPECT_EQ(metadata["data_hash"].get<std::string>().size(), 16U);
  EXPECT_EQ(metadata["command"].get<std::string>().rfind("./prospect train --task stacking", 0), 0U)
      << metadata["command"];
  EXPECT_GT(metadata["train"]["transform_image"]["iterations"].get<int>(), 0);
  for (const json& before : metadata.value("history", json::array())) {
    EXPECT_EQ(before["command"].get<std::string>().rfind("./prospect train --task stacking", 0), 0U)
        << before["command"];
  }
  EXPECT_GT(metadata["scores"]["trials"].get<int>(), 100);
  EXPECT_EQ(metadata["trial_seeds"].size(), 2U);
}

TEST(BundledWeights, KnowWhatTheirPicturesLookLike) {
  for (const char* task : {"stacking", "navigation"}) {
    const std::string file = kRoot + "/model/weights/" + task + ".safetensors";
    EXPECT_TRUE(NoveltyGauge::Load(file)) << task;
    EXPECT_FALSE(SamplesOf(CalibrationsOf(file)).empty()) << task;
  }
}

TEST(BundledWeights, AreSmall) {
  EXPECT_LE(fs::file_size(kWeights) + fs::file_size(ClassifiersPath(kWeights)), 16'000'000U);
  EXPECT_LE(fs::file_size(kTrials), 8'000'000U);
}

TEST(BundledWeights, NeverSawTheHeldOutTrials) {
  const TrialFile file(kTrials);
  EXPECT_GE(file.size(), 20U);
  for (const std::uint64_t seed : file.seeds()) EXPECT_EQ(SplitOf(seed), Split::kTest) << seed;
  EXPECT_EQ(file.ReadLabels(0).world_version,
            ReadWeights(kWeights).metadata["world_version"].get<std::string>());
}

class Scored : public ::testing::Test {
 protected:
  /// Once for all tests.
  void SetUp() override {
    if (scores_ != nullptr) return;
    const TestFolder folder;
    TrainOptions options;
    options.task = "stacking";
    options.data = kTrials;
    options.folder = folder / "scores";
    options.score_only = true;
    Trainer trainer(ReadWeights(kWeights).metadata["train"].get<TrainConfig>(), options);
    trainer.Load(kWeights);
    scores_ = new json(ComputeScores(trainer.context(), trainer.file(), options.threads));
  }
  static void TearDownTestSuite() {
    delete scores_;
    scores_ = nullptr;
  }
  static const json& Kept() {
    static const json kept = [] {
      std::ifstream in(kScores);
      return json::parse(in);
    }();
    return kept;
  }
  static void Expect(const std::string& pointer, double tolerance) {
    const json::json_pointer at(pointer);
    const double kept = Kept().at(at).get<double>();
    EXPECT_NEAR(scores_->at(at).get<double>(), kept, tolerance) << pointer;
  }

  static json* scores_;
};
json* Scored::scores_ = nullptr;

TEST_F(Scored, PicturesAreWhatTheyWere) {
  for (const char* step : {"/pictures/x1/", "/pictures/x2/"}) {
    for (const char* kind : {"mae_clean", "mae_changed_clean", "reconstruction_mae_clean"}) {
      const std::string pointer = std::string(step) + kind;
      Expect(pointer, kErrorShare * Kept().at(json::json_pointer(pointer)).get<double>());
    }
  }
}

TEST_F(Scored, PicturesAreFarBetterThanCopyingX) {
  for (const char* step : {"x1", "x2"}) {
    const json& s = scores_->at("pictures").at(step);
    EXPECT_LT(s["mae_clean"].get<double>(), 0.5 * s["copy_mae_clean"].get<double>()) << step;
  }
}

TEST_F(Scored, LabelsAndJudgementsAreWhatTheyWere) {
  Expect("/labels/x1/second", kAnswers);
  Expect("/labels/x2/second", kAnswers);
  for (const char* head : {"/value/", "/f/", "/p/", "/q/"}) {
    for (const char* of : {"real", "after_one", "after_two"}) {
      Expect(std::string(head) + of + "/brier", kAnswers);
      Expect(std::string(head) + of + "/area_under_roc", kAnswers);
    }
  }
}

}  // namespace
}  // namespace prospect::model

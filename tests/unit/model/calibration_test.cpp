// The calibration in a weights file: what is stored comes back, belongs to its tensors, and leaves
// the rest of the file alone.
#include "model/calibration.h"

#include <gtest/gtest.h>

#include <string>

#include "model/refusal/scene_kind.h"
#include "model/weights.h"
#include "tests/unit/model/refusal_sample.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

using nlohmann::json;

class CalibrationFile : public ::testing::Test {
 protected:
  CalibrationFile() : path_(folder_ / "w.safetensors") {
    tensors_["a.weight"] = torch::arange(6, torch::kFloat).view({2, 3});
    Write(json::object());
  }
  void Write(const json& calibration) const {
    WriteWeights(path_, tensors_,
                 {{"task", "made"}, {"novelty", {1, 2}}, {"calibration", calibration}});
  }
  static Calibration Made() {
    Calibration made;
    made.refusal_threshold = 0.25;
    made.alpha = 0.05;
    made.epsilon = 0.1;
    made.delta = 0.2;
    made.scenes = 3;
    made.command = "made by hand";
    made.sample = SampleOf({Scene(0, 'h', 'R'), Scene(0.25, 's', 'T'), Scene(0.5, 'd', 'F'),
                            Scene(0.123456, 's', 'S')});
    made.sample.rule = "paper";
    made.sample.parameters = {{"samples", 30}, {"v_failed", 0.02}};
    return made;
  }
  void ExpectRefused(const std::string& reason) const {
    try {
      CalibrationsOf(path_);
      FAIL() << "expected a refusal: " << reason;
    } catch (const WeightsError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }

  TestFolder folder_;
  std::string path_;
  std::map<std::string, torch::Tensor> tensors_;
};

TEST_F(CalibrationFile, ComesBackAsItWasStored) {
  StoreCalibration(path_, Made());
  const Calibration back = CalibrationsOf(path_).at(0), made = Made();
  EXPECT_EQ(back.refusal_threshold, made.refusal_threshold);
  EXPECT_EQ(back.alpha, made.alpha);
  EXPECT_EQ(back.epsilon, made.epsilon);
  EXPECT_EQ(back.delta, made.delta);
  EXPECT_EQ(back.scenes, made.scenes);
  EXPECT_EQ(back.command, made.command);
  EXPECT_EQ(back.sample.rule, made.sample.rule);
  EXPECT_EQ(back.sample.parameters, made.sample.parameters);
  ASSERT_EQ(back.sample.scenes.size(), made.sample.scenes.size());
  for (std::size_t i = 0; i < made.sample.scenes.size(); ++i) {
    EXPECT_EQ(back.sample.scenes[i].score, made.sample.scenes[i].score);
    EXPECT_EQ(back.sample.scenes[i].scene_class, made.sample.scenes[i].scene_class);
    EXPECT_EQ(back.sample.scenes[i].ending, made.sample.scenes[i].ending);
  }
}

TEST_F(CalibrationFile, LeavesTensorsAndOtherMetadataAlone) {
  const WeightsFile before = ReadWeights(path_);
  StoreCalibration(path_, Made());
  const WeightsFile after = ReadWeights(path_);
  EXPECT_EQ(TensorsHash(before), TensorsHash(after));
  EXPECT_NE(before.hash, after.hash);
  EXPECT_EQ(after.metadata["novelty"], json({1, 2}));
  EXPECT_EQ(after.tensors.at("a.weight").bytes, before.tensors.at("a.weight").bytes);
}

TEST_F(CalibrationFile, OfOtherTensorsIsRefused) {
  StoreCalibration(path_, Made());
  const json calibration = ReadWeights(path_).metadata["calibration"];
  Write(calibration);
  EXPECT_EQ(CalibrationsOf(path_).at(0).sample.scenes.size(), 4u);
  tensors_["a.weight"][1][2] += 1;
  Write(calibration);
  ExpectRefused("was made for other weights");
  tensors_["a.weight"][1][2] -= 1;
  tensors_["b.weight"] = torch::zeros({1});
  Write(calibration);
  ExpectRefused("was made for other weights");
}

// What pictures are known lies in tensors of the same file, and may be stored later.
TEST_F(CalibrationFile, StaysWhenWhatIsKnownOfPicturesIsStored) {
  StoreCalibration(path_, Made());
  WeightsFile file = ReadWeights(path_);
  file.tensors["novelty.axes"] = HalfTensor({2, 2}, {1, 1, 1, 1});
  WriteWeights(path_, file.tensors, file.metadata);
  EXPECT_DOUBLE_EQ(CalibrationsOf(path_).at(0).refusal_threshold, 0.25);
}

// Scenes of another kind have a threshold of their own.
TEST_F(CalibrationFile, KeepsOneForEachKindOfScenes) {
  const auto of = [](int plan_length, double threshold) {
    Calibration made = Made();
    made.sample.parameters["plan_length"] = plan_length;
    made.refusal_threshold = threshold;
    return made;
  };
  Write({{"refusal_threshold", 0.31}});  // training's own, of no kind
  StoreCalibration(path_, of(3, 0.1));
  StoreCalibration(path_, of(5, 0.2));
  StoreCalibration(path_, of(3, 0.4));
  const std::vector<Calibration> both = CalibrationsOf(path_);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].refusal_threshold, 0.4);
  EXPECT_EQ(KindOf(both[0].sample).plan_length, 3);
  EXPECT_EQ(both[1].refusal_threshold, 0.2);
  EXPECT_EQ(both[1].sample.refusal_threshold, 0.2);
  EXPECT_EQ(KindOf(both[1].sample).plan_length, 5);
}

TEST_F(CalibrationFile, OldFilesHaveAThresholdAndNoSample) {
  Write({{"refusal_threshold", 0.31}, {"alpha", 0.05}, {"scenes", 70}, {"command", "old"}});
  const Calibration old = CalibrationsOf(path_).at(0);
  EXPECT_EQ(old.refusal_threshold, 0.31);
  EXPECT_EQ(old.alpha, 0.05);
  EXPECT_FALSE(old.epsilon);
  EXPECT_TRUE(old.sample.empty());
  WriteWeights(path_, tensors_, {{"task", "made"}});
  EXPECT_TRUE(CalibrationsOf(path_).empty());
}

TEST_F(CalibrationFile, DamageIsNamed) {
  StoreCalibration(path_, Made());
  const json good = ReadWeights(path_).metadata["calibration"];
  json bad = good;
  bad["sample"]["classes"] = "hs";
  Write(bad);
  ExpectRefused("its calibration is damaged");
  bad = good;
  bad["sample"]["endings"] = "RTF?";
  Write(bad);
  ExpectRefused("its calibration is damaged");
  bad = good;
  bad["sample"]["scores"][0] = 1.5;
  Write(bad);
  ExpectRefused("its calibration is damaged");
  bad = good;
  bad["refusal_threshold"] = "much";
  Write(bad);
  ExpectRefused("its calibration is damaged");
}

}  // namespace
}  // namespace prospect::model

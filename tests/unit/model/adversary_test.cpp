#include "model/training/adversary.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "model/training/variants.h"
#include "tests/unit/model/task_config.h"

namespace prospect::model {
namespace {

TrainConfig ConfigOf(const std::string& variant) {
  TrainConfig config;
  config.network.image_width = config.network.image_height = 32;
  config.network.num_actions = 3;
  config.network.dropout = 0;
  ApplyVariant(variant, &config);
  return config;
}

JudgedPair Pair(double brightness) {
  return {torch::full({4, 3, 32, 32}, brightness), torch::full({4, 3, 32, 32}, brightness),
          torch::tensor({0, 1, 2, 0})};
}

bool AnyGradient(const torch::nn::Module& module) {
  for (const torch::Tensor& tensor : module.parameters()) {
    if (tensor.grad().defined() && tensor.grad().abs().sum().item<double>() > 0) return true;
  }
  return false;
}

class AdversaryTest : public ::testing::TestWithParam<const char*> {
 protected:
  AdversaryTest() : adversary(ConfigOf(GetParam())) {}
  Adversary adversary;
  CounterRandom random{1, 2, 3};
};

TEST_P(AdversaryTest, TheJudgesLossReachesTheJudgeOnly) {
  JudgedPair imagined = Pair(0.4);
  imagined.x1.set_requires_grad(true);
  adversary.JudgesLoss(Pair(0.6), imagined, &random).backward();
  EXPECT_TRUE(AnyGradient(*adversary.judge()));
  EXPECT_FALSE(imagined.x1.grad().defined());
}

TEST_P(AdversaryTest, TheGeneratorsLossReachesThePicturesOnly) {
  JudgedPair imagined = Pair(0.4);
  imagined.x1.set_requires_grad(true);
  imagined.x2.set_requires_grad(true);
  adversary.GeneratorsLoss(imagined).backward();
  EXPECT_FALSE(AnyGradient(*adversary.judge()));
  EXPECT_GT(imagined.x1.grad().abs().sum().item<double>(), 0);
  EXPECT_GT(imagined.x2.grad().abs().sum().item<double>(), 0);
}

// Bright pictures are real, dark ones imagined: after some steps the judge knows, and the
// generator's loss says which way to go.
TEST_P(AdversaryTest, TheJudgeLearnsToTellThemApart) {
  torch::optim::Adam adam(adversary.judge()->parameters(), 1e-3);
  const double before = adversary.JudgesLoss(Pair(0.8), Pair(0.2), &random).item<double>();
  for (int i = 0; i < 20; ++i) {
    adam.zero_grad();
    adversary.JudgesLoss(Pair(0.8), Pair(0.2), &random).backward();
    adam.step();
    adversary.AfterStep();
  }
  EXPECT_LT(adversary.JudgesLoss(Pair(0.8), Pair(0.2), &random).item<double>(), before);
  EXPECT_LT(adversary.GeneratorsLoss(Pair(0.8)).item<double>(),
            adversary.GeneratorsLoss(Pair(0.2)).item<double>());
}

INSTANTIATE_TEST_SUITE_P(Both, AdversaryTest, testing::Values("cgan", "wgan"));

TEST(Wasserstein, WeightsAreCutAfterEveryStepAndTheGeneratorWaitsForItsTurn) {
  TrainConfig config = ConfigOf("wgan");
  config.judge_steps = 3;
  Adversary adversary(config);
  adversary.AfterStep();
  for (const torch::Tensor& tensor : adversary.judge()->parameters())
    EXPECT_LE(tensor.abs().max().item<double>(), config.judge_clip * 1.0001);
  int turns = 0;
  for (int i = 0; i < 40; ++i) turns += adversary.GeneratorsTurn(i) ? 1 : 0;
  EXPECT_EQ(turns, 10);
}

TEST(Variants, AreAllValidAndDiffer) {
  std::set<std::string> seen;
  for (const Variant& variant : Variants()) {
    TrainConfig config = TrainConfigFor("stacking");
    ApplyVariant(variant.name, &config);
    Validate(config);
    EXPECT_TRUE(seen.insert(nlohmann::json(config).dump()).second) << variant.name;
  }
  EXPECT_EQ(seen.size(), 8U);
}

TEST(Variants, CWeighsAsMuchBesideAPictureLossOfAnyWeight) {
  TrainConfig one, hundred;
  hundred.picture_weight = 100;
  for (TrainConfig* config : {&one, &hundred}) ApplyVariant("l1+0.01c", config);
  EXPECT_DOUBLE_EQ(one.lambda, 0.01);
  EXPECT_DOUBLE_EQ(hundred.lambda, 1);
}

TEST(Variants, AnUnknownOneIsRefusedWithTheKnown) {
  TrainConfig config;
  try {
    ApplyVariant("l3", &config);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("l1+0.01c"), std::string::npos);
  }
}

}  // namespace
}  // namespace prospect::model

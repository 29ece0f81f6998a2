// What a task file may ask for at its bounds: networks of that size train, are written, and answer
// alike in the engine that trains them and in the one that plans with them.
#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "model/engine.h"
#include "model/training/derived_config.h"
#include "model/training/export.h"
#include "model/training/trainer.h"
#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

struct Size {
  const char* name;
  int width, height;  // of a picture; at most as high as wide
  int num_actions;
  int plan_length;
};

Trial TrialOf(const Size& size, std::uint64_t seed) {
  const bool fails = seed % 3 == 0;
  Trial trial = MadeTrial(seed, size.plan_length, fails, 2, size.width, size.num_actions);
  std::vector<std::uint8_t> cut;
  const auto square = static_cast<std::size_t>(size.width * size.width * 3);
  const auto kept = static_cast<std::ptrdiff_t>(size.width * size.height * 3);
  for (std::size_t at = 0; at < trial.images.size(); at += square) {
    const auto from = trial.images.begin() + static_cast<std::ptrdiff_t>(at);
    cut.insert(cut.end(), from, from + kept);
  }
  trial.images = std::move(cut);
  trial.height = size.height;
  // The last of the table is carried out, too: the index before the one that means "none yet".
  for (std::int32_t& action : trial.actions) action += action == 2 ? size.num_actions - 3 : 0;
  for (std::int32_t& action : trial.prev_action) action += action == 2 ? size.num_actions - 3 : 0;
  return trial;
}

class TaskSizes : public testing::TestWithParam<Size> {
 protected:
  std::string Data() const {
    std::vector<std::string> parts;
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
      parts.push_back(folder_ / (std::to_string(seed) + ".h5"));
      WriteTrialFile(parts.back(), TrialOf(GetParam(), seed));
    }
    PackTrialFiles(parts, folder_ / "all.h5");
    return folder_ / "all.h5";
  }

  TrainConfig Config() const {
    const Size& size = GetParam();
    TrainConfig config =
        DerivedConfig({size.width, size.height, size.num_actions, size.plan_length, 10});
    config.classifier = {1, 1, 1e-3};
    config.encoder_decoder = {1, 1, 1e-3};
    config.transform_hidden = {1, 1, 1e-3};
    config.transform_image = {1, 1, 1e-3};
    config.heads = {1, 2, 1e-3};
    return config;
  }

  TestFolder folder_;
};

void ExpectAlike(const Prediction& a, const Prediction& b) {
  EXPECT_NEAR(a.value, b.value, 1e-4F);
  EXPECT_NEAR(a.done, b.done, 1e-4F);
  ASSERT_EQ(a.p.size(), b.p.size());
  for (std::size_t i = 0; i < a.p.size(); ++i) {
    EXPECT_NEAR(a.p[i], b.p[i], 1e-4F) << i;
    EXPECT_NEAR(a.q[i], b.q[i], 1e-4F) << i;
  }
}

TEST_P(TaskSizes, TrainAndAreAnsweredAlikeByBothEngines) {
  const Size& size = GetParam();
  TrainOptions options;
  options.task = "made";
  options.data = Data();
  options.folder = folder_ / "run";
  Trainer trainer(Config(), options);
  trainer.Run();
  const std::string weights = ExportWeights(trainer, {});
  const auto torch = LoadTorchEngine(weights, 1);
  const auto native = LoadEngine(weights, 1);
  ASSERT_EQ(native->info().num_actions, size.num_actions);
  const auto picture = TrialOf(size, 1).images;
  const auto pixels =
      std::span(picture).first(static_cast<std::size_t>(size.width * size.height * 3));
  const Hidden h0 = torch->Encode(pixels);
  ExpectAlike(native->Evaluate(h0, h0, size.num_actions),
              torch->Evaluate(h0, h0, size.num_actions));
  for (const int action : {0, size.num_actions - 1})
    ExpectAlike(native->Expand({{h0, h0, action}}).at(0), torch->Expand({{h0, h0, action}}).at(0));
  const auto a = native->Decode({h0}).at(0), b = torch->Decode({h0}).at(0);
  ASSERT_EQ(a.size(), pixels.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_LE(std::abs(int{a[i]} - int{b[i]}), 1) << i;
}

INSTANTIATE_TEST_SUITE_P(Bounds, TaskSizes,
                         testing::Values(Size{"Smallest", 32, 32, 3, 1},
                                         Size{"Oblong", 48, 32, 3, 2},
                                         Size{"Largest", 256, 256, 3, 1},
                                         Size{"MostActions", 32, 32, 255, 2},
                                         Size{"LongestPlan", 32, 32, 3, 64}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace prospect::model

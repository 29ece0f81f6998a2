#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/dataset.h"
#include "model/training/heads_stage.h"
#include "model/training/trainer.h"
#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

using Rows = std::vector<float>;

/// Trial 0 succeeds with actions 0 and 1, trial 1 fails in the second of 1 and 2.
SampleSet TwoTrials() {
  SampleSet set;
  AddTrial(MadeTrial(0, 2, false, 6), 0, 1, &set);
  AddTrial(MadeTrial(1, 2, true, 6), 1, 1, &set);
  return set;
}

/// The first state, then the end and the inside of either action.
StateLabels LabelsOf(const SampleSet& set, int trial, bool authors) {
  StateLabels labels(set, authors, 0.25);
  labels.AddFirst(trial);
  for (int s = 2 * trial; s < 2 * trial + 2; ++s) {
    labels.AddGoal(s);
    labels.AddInside(s);
  }
  return labels;
}

TEST(StateLabels, OfThePaper) {
  const SampleSet set = TwoTrials();
  const StateLabels solved = LabelsOf(set, 0, false), failed = LabelsOf(set, 1, false);
  EXPECT_EQ(solved.action, (std::vector<int>{3, 0, 0, 1, 1}));
  EXPECT_EQ(solved.value, (Rows{1, 1, 1, 1, 1}));
  EXPECT_EQ(failed.value, (Rows{0, 0, 0, 0, 0}));
  EXPECT_EQ(solved.done, (Rows{0, 1, 0, 1, 0})) << "each action that succeeded";
  EXPECT_EQ(failed.done, (Rows{0, 1, 0, 0, 0})) << "the second one failed";
  EXPECT_EQ(solved.f_weight, (Rows{0, 1, 0.25, 1, 0.25})) << "not asked before the first action";
  EXPECT_EQ(solved.structure, (Rows{1, 1, 0, 1, 0})) << "only between actions";
  EXPECT_EQ(solved.p, (Rows{1, 1, 1, 0, 1, 1, 0, 1, 1, 1, 0, 1, 1, 0, 1})) << "what may follow";
  const float none = -1;
  EXPECT_EQ(solved.q, (Rows{1, none, none, none, 1, none, none, none, none, none, none, none, none,
                            none, none}))
      << "the action carried out next";
  EXPECT_EQ(failed.q, (Rows{none, 0, none, none, none, 0, none, none, none, none, none, none, none,
                            none, none}));
}

// "f 1 exactly on the first frame of each segment": the end of the first action is the first frame
// of the second one; a trial's last frame still belongs to its last action.
TEST(StateLabels, OfTheAuthors) {
  const SampleSet set = TwoTrials();
  const StateLabels solved = LabelsOf(set, 0, true), failed = LabelsOf(set, 1, true);
  EXPECT_EQ(solved.action, (std::vector<int>{3, 0, 0, 1, 1}));
  EXPECT_EQ(solved.value, (Rows{1, 1, 1, 1, 1}));
  EXPECT_EQ(failed.value, (Rows{0, 0, 0, 0, 0}));
  EXPECT_EQ(solved.done, (Rows{0, 1, 0, 0, 0}));
  EXPECT_EQ(failed.done, (Rows{0, 1, 0, 0, 0}));
  EXPECT_EQ(solved.structure, (Rows{1, 1, 1, 1, 1})) << "on every frame";
  EXPECT_EQ(solved.p, (Rows{1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0})) << "the frame's action";
  EXPECT_EQ(solved.q, solved.p);
  EXPECT_EQ(failed.p, (Rows{0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(failed.q, Rows(15, 0)) << "no action leads to success";
}

TEST(StateLabels, OtherKindsAreRefused) {
  TrainConfig config;
  config.labels = "guessed";
  EXPECT_THROW(Validate(config), std::invalid_argument);
  EXPECT_THROW(nlohmann::json({{"labels", "guessed"}}).get_to(config), std::invalid_argument);
  nlohmann::json({{"labels", "authors"}}).get_to(config);
  EXPECT_EQ(nlohmann::json(config)["labels"], "authors");
}

std::multiset<std::string> StagesIn(const std::string& folder) {
  std::multiset<std::string> names;  // without the key at the end
  for (const auto& entry : std::filesystem::directory_iterator(folder + "/stages")) {
    const std::string name = entry.path().filename().string();
    names.insert(name.substr(0, name.rfind('-')));
  }
  return names;
}

TEST(StateLabels, ChangeTheHeadsAndNothingElse) {
  const TestFolder folder;
  std::vector<std::string> parts;
  for (int seed = 0; seed < 30; ++seed) {
    parts.push_back(folder / std::to_string(seed));
    WriteTrialFile(parts.back(),
                   MadeTrial(static_cast<std::uint64_t>(seed), 2, seed % 3 == 0, 6, 32));
  }
  PackTrialFiles(parts, folder / "all.h5");
  TrainConfig config;
  config.network.image_width = config.network.image_height = 32;
  config.network.num_actions = 3;
  for (StageConfig* stage : {&config.classifier, &config.encoder_decoder, &config.transform_hidden,
                             &config.transform_image, &config.heads}) {
    *stage = {2, 2, 1e-3};
  }
  TrainOptions options;
  options.task = "made";
  options.data = folder / "all.h5";
  options.folder = folder / "run";
  const auto weights_of = [&](const std::string& labels, const std::string& network) {
    config.labels = labels;
    Trainer trainer(config, options);
    trainer.Run();
    std::vector<torch::Tensor> all;
    for (const auto& [name, module] : trainer.context().networks.named()) {
      for (const torch::Tensor& tensor : module->parameters()) {
        if (name == network) all.push_back(tensor.detach().flatten().clone());
      }
    }
    return torch::cat(all);
  };
  const torch::Tensor paper = weights_of("paper", "p");
  const std::multiset<std::string> before = StagesIn(options.folder);
  EXPECT_FALSE(weights_of("authors", "p").equal(paper));
  EXPECT_TRUE(weights_of("paper", "p").equal(paper));
  std::multiset<std::string> expected = before;
  expected.insert("heads");
  EXPECT_EQ(StagesIn(options.folder), expected) << "all else was there already";
}

}  // namespace
}  // namespace prospect::model

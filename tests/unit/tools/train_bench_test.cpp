#include "tools/bench/train_bench.h"

#include <gtest/gtest.h>
#include <torch/torch.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "model/dataset.h"
#include "sim/task_factory.h"
#include "tasks/task_file.h"
#include "tests/unit/model/test_folder.h"
#include "tools/bench/multiply_adds.h"
#include "tools/bench/random_trials.h"

namespace prospect::tools {
namespace {

torch::nn::Conv2d Convolution(int in, int out, int stride) {
  return torch::nn::Conv2d(torch::nn::Conv2dOptions(in, out, 5).stride(stride).padding(2));
}

// Each number of the output takes input channels x 25 multiply-adds; the backward pass takes as
// many for the gradient of the weights and as many again for the input's, where that is wanted.
TEST(MultiplyAdds, CountsConvolutionsOfBothPasses) {
  torch::nn::Conv2d first = Convolution(3, 8, 1), second = Convolution(8, 4, 2);
  const MultiplyAdds counter;
  const torch::Tensor y = second->forward(first->forward(torch::ones({2, 3, 16, 16})));
  const std::int64_t of_first = 2 * 8 * 16 * 16 * 3 * 25, of_second = 2 * 4 * 8 * 8 * 8 * 25;
  EXPECT_EQ(MultiplyAdds::forward(), of_first + of_second);
  EXPECT_EQ(MultiplyAdds::backward(), 0);
  y.sum().backward();
  EXPECT_EQ(MultiplyAdds::forward(), of_first + of_second);
  EXPECT_EQ(MultiplyAdds::backward(), of_first + 2 * of_second) << "no gradient of the picture";
}

TEST(MultiplyAdds, CountsNoGradientsOfWhatIsFrozen) {
  torch::nn::Conv2d first = Convolution(3, 8, 1), second = Convolution(8, 4, 2);
  for (torch::Tensor& tensor : second->parameters()) tensor.set_requires_grad(false);
  const std::int64_t of_first = 2 * 8 * 16 * 16 * 3 * 25, of_second = 2 * 4 * 8 * 8 * 8 * 25;
  const MultiplyAdds counter;
  second->forward(first->forward(torch::ones({2, 3, 16, 16}))).sum().backward();
  EXPECT_EQ(MultiplyAdds::backward(), of_first + of_second);
}

TEST(MultiplyAdds, CountsDenseLayersAndOnlyWhileItLives) {
  torch::nn::Linear dense(10, 7);
  dense->forward(torch::ones({5, 10}));
  {
    const MultiplyAdds counter;
    const torch::Tensor x = torch::ones({5, 10}).set_requires_grad(true);
    dense->forward(x).sum().backward();
    EXPECT_EQ(MultiplyAdds::forward(), 5 * 10 * 7);
    EXPECT_EQ(MultiplyAdds::backward(), 2 * 5 * 10 * 7);
  }
  dense->forward(torch::ones({5, 10}));
  EXPECT_EQ(MultiplyAdds::forward(), 5 * 10 * 7);
}

TEST(RandomTrials, AreValidAndOfTheTasksShape) {
  for (const std::string& task : sim::TaskNames()) {
    const sim::TaskSpec spec = sim::MakeTask(task)->spec();
    std::set<bool> outcomes;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const model::Trial trial = RandomTrial(spec, seed);
      model::ValidateTrial(trial);
      outcomes.insert(trial.succeeded());
      EXPECT_EQ(trial.task, task);
      EXPECT_EQ(trial.segments() == spec.plan_length || !trial.succeeded(), true);
    }
    EXPECT_EQ(outcomes.size(), 2u);
  }
}

// While one lives, temporary files are made in `folder`.
class TemporaryFilesIn {
 public:
  explicit TemporaryFilesIn(const std::string& folder)
      : before_(std::filesystem::temp_directory_path()) {
    ::setenv("TMPDIR", folder.c_str(), 1);
  }
  ~TemporaryFilesIn() { ::setenv("TMPDIR", before_.c_str(), 1); }

 private:
  std::string before_;
};

TEST(TrainBench, MeasuresEveryStage) {
  const model::TestFolder folder;
  const TemporaryFilesIn here(folder.path());
  cli::BenchTrainOptions options;
  options.task = "navigation";
  options.seconds = 0;  // the fewest steps
  const nlohmann::json figures = BenchTraining(options);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "what it made is removed";
  EXPECT_GT(figures["matrix_product_gflops"].get<double>(), 0);
  std::set<std::string> stages;
  for (const nlohmann::json& row : figures["rows"]) {
    const std::string stage = row["stage"].get<std::string>();
    stages.insert(stage);
    for (const char* key :
         {"batch", "samples_per_s", "images_per_sample", "images_per_s", "forward", "backward",
          "gflops", "peak_share", "busy_cores", "iterations", "minutes", "steps", "seconds"}) {
      EXPECT_GT(row.at(key).get<double>(), 0) << stage << " " << key;
    }
    EXPECT_LT(row["backward"].get<double>(), 2 * row["forward"].get<double>()) << stage;
    EXPECT_NEAR(row["gflops"].get<double>(),
                2e-9 * row["samples_per_s"].get<double>() *
                    (row["forward"].get<double>() + row["backward"].get<double>()),
                1e-6)
        << stage;
  }
  EXPECT_EQ(stages, (std::set<std::string>{"classifier", "encoder-decoder", "transform-hidden",
                                           "transform-image", "heads"}));
}

TEST(TrainBench, AnUnknownTaskOrPrecisionIsRefused) {
  cli::BenchTrainOptions options;
  options.task = "navigation";
  options.precision = "double";
  EXPECT_THROW(BenchTraining(options), std::invalid_argument);
  options.precision = "float32";
  options.task = "juggling";
  EXPECT_THROW(BenchTraining(options), tasks::TaskFileError);
}

}  // namespace
}  // namespace prospect::tools

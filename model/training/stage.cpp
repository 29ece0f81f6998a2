#include "model/training/stage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "base/atomic_file.h"
#include "base/hash.h"
#include "base/line_file.h"
#include "base/quiet.h"
#include "base/seconds_since.h"
#include "model/networks/blocks.h"
#include "model/networks/precision.h"
#include "model/training/parallel.h"
#include "model/training/progress.h"
#include "model/training/random.h"

namespace prospect::model {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::int64_t kWarmUp = 100;   // iterations over which the learning rate rises
constexpr double kLastRate = 0.01;      // share of the learning rate at the end
constexpr double kClipNorm = 100.0;     // gradient norm, as the authors'
constexpr std::int64_t kLogEvery = 25;  // iterations a row of the curves averages over
constexpr double kAdamEpsilon = 1e-7;   // Keras' default, as the authors'

double RateAt(const StageConfig& config, std::int64_t iteration) {
  const double warm = std::min(1.0, static_cast<double>(iteration + 1) / kWarmUp);
  const double share = static_cast<double>(iteration) / static_cast<double>(config.iterations);
  const double cosine = 0.5 * (1.0 + std::cos(M_PI * share));
  return config.learning_rate * warm * (kLastRate + (1.0 - kLastRate) * cosine);
}

/// Averages of the loss parts since the last row.
struct Means {
  std::vector<std::pair<std::string, double>> sums;
  std::int64_t count = 0;

  void Add(const std::vector<std::pair<std::string, double>>& parts) {
    if (sums.empty())
      sums = parts;
    else
      for (std::size_t i = 0; i < parts.size(); ++i) sums[i].second += parts[i].second;
    ++count;
  }
  std::vector<std::pair<std::string, double>> Take() {
    for (auto& [name, sum] : sums) sum /= static_cast<double>(std::max<std::int64_t>(1, count));
    count = 0;
    return std::exchange(sums, {});
  }
};

/// The rows of DIR/curves.csv: stage,iteration,name,value. After a resume, rows of iterations that
/// will be computed again are dropped first.
class Curves {
 public:
  Curves(const std::string& folder, std::string stage, std::int64_t keep_to)
      : path_(folder + "/curves.csv"), stage_(std::move(stage)) {
    Drop(keep_to);
  }
  void Write(std::int64_t iteration,
             const std::vector<std::pair<std::string, double>>& means) const {
    std::ostringstream rows;
    const char* between = "";
    for (const auto& [name, value] : means) {
      rows << std::exchange(between, "\n") << stage_ << ',' << iteration << ',' << name << ','
           << value;
    }
    base::AppendLine(path_, rows.str());
  }

 private:
  bool Keeps(const std::string& line, std::int64_t keep_to) const {
    const std::string prefix = stage_ + ",";
    if (!line.starts_with(prefix)) return true;
    return std::strtoll(line.c_str() + prefix.size(), nullptr, 10) <= keep_to;
  }
  void Drop(std::int64_t keep_to) const {
    std::string kept = "stage,iteration,name,value\n";
    std::ifstream in(path_);
    std::string line;
    std::getline(in, line);  // the heading
    while (std::getline(in, line)) {
      if (Keeps(line, keep_to)) kept += line + "\n";
    }
    base::WriteFile(path_, kept);
  }

  std::string path_;
  std::string stage_;
};

std::string NoteOf(const std::vector<std::pair<std::string, double>>& means) {
  std::string note;
  for (const auto& [name, value] : means) {
    char text[64];
    std::snprintf(text, sizeof text, "%s %.5f  ", name.c_str(), value);
    note += text;
  }
  return note;
}

/// How far a stage on disk has come.
struct Stored {
  std::int64_t iteration = -1;
  double seconds = 0;
};

/// Weights, optimizer and iteration of a stage on disk.
class StageFile {
 public:
  /// Without an optimizer its state is neither stored nor loaded: for finished stages.
  StageFile(const Stage& stage, const StageRun& run, torch::optim::Optimizer* optimizer)
      : stage_(stage), run_(run), optimizer_(optimizer) {}

  std::string finished() const { return run_.folder + "/stage-" + stage_.name() + ".pt"; }
  std::string checkpoint() const { return run_.folder + "/stage-" + stage_.name() + ".checkpoint"; }

  void Save(const std::string& path, std::int64_t iteration, double seconds) const {
    torch::serialize::OutputArchive archive;
    archive.write("key", c10::IValue(run_.key));
    archive.write("iteration", c10::IValue(iteration));
    archive.write("seconds", c10::IValue(seconds));
    for (const auto& [name, module] : stage_.modules()) {
      torch::serialize::OutputArchive part;
      module->save(part);
      archive.write(name, part);
    }
    if (optimizer_ != nullptr) WriteOptimizer(&archive);
    // By way of memory: libtorch ends the process when it cannot write a file.
    std::ostringstream bytes;
    archive.save_to(bytes);
    base::WriteFile(path, bytes.str());
  }

  /// What is stored; iteration -1 if there is no such file, it does not open, or it is of another
  /// key.
  Stored Load(const std::string& path) const {
    if (!fs::exists(path)) return {};
    try {
      return LoadWhole(path);
    } catch (const c10::Error&) {
      std::fprintf(stderr, "%s: does not open as a checkpoint; this stage starts anew\n",
                   path.c_str());
      return {};
    }
  }

 private:
  void WriteOptimizer(torch::serialize::OutputArchive* archive) const {
    torch::serialize::OutputArchive steps;
    optimizer_->save(steps);
    archive->write("optimizer", steps);
  }

  Stored LoadWhole(const std::string& path) const {
    torch::serialize::InputArchive archive;
    archive.load_from(path, run_.device);
    c10::IValue key, iteration, seconds;
    archive.read("key", key);
    archive.read("iteration", iteration);
    if (key.toStringRef() != run_.key) return {};
    Stored stored{iteration.toInt(), 0};
    if (archive.try_read("seconds", seconds)) stored.seconds = seconds.toDouble();
    for (const auto& [name, module] : stage_.modules()) {
      torch::serialize::InputArchive part;
      archive.read(name, part);
      module->load(part);
    }
    if (optimizer_ == nullptr) return stored;
    torch::serialize::InputArchive steps;
    archive.read("optimizer", steps);
    optimizer_->load(steps);
    return stored;
  }

  const Stage& stage_;
  const StageRun& run_;
  torch::optim::Optimizer* optimizer_;
};

/// One group of parameters a module, in the order of modules().
std::unique_ptr<torch::optim::Optimizer> MakeOptimizer(const Stage& stage) {
  std::vector<torch::optim::OptimizerParamGroup> groups;
  for (const auto& [name, module] : stage.modules()) groups.emplace_back(module->parameters());
  const double rate = stage.config().learning_rate;
  if (stage.optimizer() == "rmsprop") {
    return std::make_unique<torch::optim::RMSprop>(groups, torch::optim::RMSpropOptions(rate));
  }
  return std::make_unique<torch::optim::Adam>(groups,
                                              torch::optim::AdamOptions(rate).eps(kAdamEpsilon));
}

std::vector<torch::Tensor> ParametersOf(const Stage& stage) {
  std::vector<torch::Tensor> all;
  for (const auto& [name, module] : stage.modules()) {
    for (const torch::Tensor& tensor : module->parameters()) all.push_back(tensor);
  }
  return all;
}

struct ShardResult {
  std::vector<torch::Tensor> gradients;
  LossParts loss;
};

/// One optimisation step. Shards are computed in parallel and added in their order.
class Stepper {
 public:
  Stepper(Stage* stage, const StageRun& run, std::vector<torch::Tensor> parameters,
          torch::optim::Optimizer* optimizer)
      : stage_(stage),
        run_(run),
        parameters_(std::move(parameters)),
        optimizer_(optimizer),
        shards_(run.device.is_cpu() ? run.shards : 1) {}

  std::vector<std::pair<std::string, double>> Step(std::int64_t iteration) {
    std::vector<ShardResult> results(static_cast<std::size_t>(shards_));
    ParallelPieces(
        shards_, 1, run_.device.is_cpu() ? run_.threads : 1, [&](std::int64_t shard, std::int64_t) {
          results[static_cast<std::size_t>(shard)] = Shard(iteration, static_cast<int>(shard));
        });
    SetGradients(results);
    torch::nn::utils::clip_grad_norm_(parameters_, kClipNorm);
    SetRates(RateAt(stage_->config(), iteration));
    optimizer_->step();
    stage_->AfterStep();
    return MeanParts(results);
  }

 private:
  ShardResult Shard(std::int64_t iteration, int shard) {
    CounterRandom random(run_.seed, base::HashText(stage_->name() + "/dropout"),
                         static_cast<std::uint64_t>(iteration * 64 + shard));
    const std::uint64_t seed = random.Next();
    SeedDropout(seed);
    const MixedPrecision precision(run_.mixed_precision);
    if (!run_.device.is_cpu()) torch::manual_seed(seed);
    ShardResult result;
    result.loss = stage_->Loss(iteration, shard, shards_);
    result.gradients =
        torch::autograd::grad({result.loss.loss}, parameters_, {}, false, false, true);
    return result;
  }

  void SetRates(double rate) {
    const auto modules = stage_->modules();
    for (std::size_t i = 0; i < modules.size(); ++i) {
      optimizer_->param_groups()[i].options().set_lr(rate * stage_->RateOf(modules[i].first));
    }
  }

  /// What the loss does not depend on in this iteration gets no gradient at all, and stays.
  void SetGradients(const std::vector<ShardResult>& results) {
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      torch::Tensor sum;
      for (const ShardResult& result : results) {
        if (!result.gradients[i].defined()) continue;
        sum = sum.defined() ? sum + result.gradients[i] : result.gradients[i];
      }
      parameters_[i].mutable_grad() = sum.defined() ? sum.div(shards_) : sum;
    }
  }

  std::vector<std::pair<std::string, double>> MeanParts(
      const std::vector<ShardResult>& results) const {
    std::vector<std::pair<std::string, double>> means = results[0].loss.parts;
    for (std::size_t s = 1; s < results.size(); ++s) {
      for (std::size_t i = 0; i < means.size(); ++i)
        means[i].second += results[s].loss.parts[i].second;
    }
    for (auto& [name, value] : means) {
      value /= shards_;
      if (!std::isfinite(value)) {
        throw ExitError(kExitTaskFailure, "stage " + stage_->name() + ": the loss '" + name +
                                              "' is no longer a number; lower its learning_rate");
      }
    }
    return means;
  }

  Stage* stage_;
  const StageRun& run_;
  std::vector<torch::Tensor> parameters_;
  torch::optim::Optimizer* optimizer_;
  int shards_;
};

void SetMode(const Stage& stage, bool training) {
  for (const auto& [name, module] : stage.modules()) module->train(training);
}

/// From what is stored to the end. Not finished if stop_after ended it early.
StageOutcome Train(Stage* stage, const StageRun& run, const StageFile& file, Stepper* stepper,
                   const Stored& stored) {
  const std::int64_t total = stage->config().iterations;
  const std::int64_t first = std::max<std::int64_t>(0, stored.iteration);
  const Curves curves(run.folder, stage->name(), first);
  ProgressLine progress(stage->name(), first);
  Means means;
  const Clock::time_point begin = Clock::now();
  const auto seconds = [&] { return stored.seconds + base::SecondsSince(begin); };
  Clock::time_point saved = begin;
  for (std::int64_t i = first; i < total; ++i) {
    if (run.stop_after >= 0 && i >= run.stop_after) return {false, seconds()};
    means.Add(stepper->Step(i));
    if ((i + 1) % kLogEvery != 0 && i + 1 != total) continue;
    const auto row = means.Take();
    curves.Write(i + 1, row);
    if (!run.quiet) progress.Show(i + 1, total, NoteOf(row));
    // Only here, so that the averages of the curves need not be stored.
    if (base::SecondsSince(saved) >= run.checkpoint_seconds) {
      file.Save(file.checkpoint(), i + 1, seconds());
      saved = Clock::now();
    }
  }
  return {true, seconds()};
}

}  // namespace

StageOutcome LoadFinished(Stage* stage, const StageRun& run) {
  const StageFile file(*stage, run, nullptr);
  const Stored stored = file.Load(file.finished());
  if (stored.iteration < 0) return {};
  SetMode(*stage, false);
  return {true, stored.seconds};
}

StageOutcome RunStage(Stage* stage, const StageRun& run) {
  fs::create_directories(run.folder);
  if (const StageOutcome before = LoadFinished(stage, run); before.finished) {
    if (!base::Quiet())
      std::fprintf(stderr, "%-18s already trained from these inputs\n", stage->name().c_str());
    return before;
  }
  const std::unique_ptr<torch::optim::Optimizer> optimizer = MakeOptimizer(*stage);
  const StageFile file(*stage, run, optimizer.get());
  SetMode(*stage, true);
  Stepper stepper(stage, run, ParametersOf(*stage), optimizer.get());
  const StageOutcome outcome = Train(stage, run, file, &stepper, file.Load(file.checkpoint()));
  if (!outcome.finished) return outcome;
  StageFile(*stage, run, nullptr)
      .Save(file.finished(), stage->config().iterations, outcome.seconds);
  fs::remove(file.checkpoint());
  SetMode(*stage, false);
  return outcome;
}

}  // namespace prospect::model

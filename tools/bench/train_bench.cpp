#include "tools/bench/train_bench.h"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "cli/options/task.h"
#include "model/training/context.h"
#include "model/training/heads_stage.h"
#include "model/training/picture_stages.h"
#include "model/training/stage.h"
#include "model/training/transform_stages.h"
#include "sim/task_factory.h"
#include "tools/bench/matrix_peak.h"
#include "tools/bench/multiply_adds.h"
#include "tools/bench/random_trials.h"
#include "tools/common/task_training.h"

namespace prospect::tools {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr int kTrials = 24;           // batches draw from them with replacement
constexpr std::int64_t kCounted = 3;  // steps that warm up, and whose multiply-adds are counted
constexpr std::int64_t kNever = 1'000'000'000;

// With landmarks, where a world knows them.
sim::TaskSpec SpecOf(const std::string& name) {
  const tasks::TaskFile& task = cli::TaskOf(name);
  return task.simulator ? sim::MakeTask(task.spec.name)->spec() : task.spec;
}

// A folder of this run's own, removed at its end.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((fs::temp_directory_path() / "prospect-train-bench-XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr) {
      throw std::runtime_error(path_ + ": cannot be made; check TMPDIR and the space left");
    }
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

// The task's, but stages that never come to their end.
model::TrainConfig Endless(model::TrainConfig config) {
  for (model::StageConfig* stage :
       {&config.classifier, &config.encoder_decoder, &config.transform_hidden,
        &config.transform_image, &config.heads}) {
    stage->iterations = kNever;
  }
  return config;
}

double ProcessSeconds() {
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Unit {
  std::string sample;  // what a batch is made of
  double images = 1;   // pictures or hidden states of one whose loss is computed
};

// A data set of random trials and fresh networks, and the stages in the order of training, since
// each freezes what the later ones do not train.
class Bench {
 public:
  Bench(const cli::BenchTrainOptions& options, const model::TrainConfig& defaults)
      : options_(options),
        defaults_(defaults),
        config_(Endless(defaults_)),
        file_(MakeData()),
        samples_(model::ReadSamples(file_, config_.mids_per_segment)),
        pictures_(folder_ / "pictures", file_, samples_, Quiet),
        context_{config_,
                 samples_,
                 pictures_,
                 nullptr,
                 model::Networks(config_.network),
                 model::DeviceNamed(options.device),
                 {}} {
    context_.networks.To(context_.device);
    context_.mean_picture =
        pictures_.Mean(samples_.FramesOf(model::Split::kTrain)).to(context_.device);
    if (config_.landmark_weight <= 0 || samples_.num_landmarks == 0) return;
    context_.landmarks =
        model::LandmarkReadout(config_.network.hidden_channels, samples_.num_landmarks,
                               model::LandmarkReadoutImpl::kHiddenScale);
    context_.landmarks->to(context_.device);
  }

  json Run() {
    double peak = Peak();
    json rows = json::array();
    const auto measure = [&](std::unique_ptr<model::Stage> stage, const Unit& unit,
                             const model::StageConfig& by_default) {
      rows.push_back(Measure(stage.get(), unit, by_default));
    };
    const double linked = config_.linked_steps;
    measure(model::MakeClassifierStage(context_, context_.networks.classifier, "classifier"),
            {"picture", 1}, defaults_.classifier);
    measure(model::MakeEncoderDecoderStage(context_), {"picture", 1}, defaults_.encoder_decoder);
    Encode();
    measure(model::MakeTransformHiddenStage(context_), {"chain", linked},
            defaults_.transform_hidden);
    measure(model::MakeTransformImageStage(context_), {"chain", linked}, defaults_.transform_image);
    measure(model::MakeHeadsStage(context_), {"trial", StatesOfTrial()}, defaults_.heads);
    peak = std::max(peak, Peak());  // again, where other programs may have been in the way
    for (json& row : rows) row["peak_share"] = row["gflops"].get<double>() / peak;
    return {{"task", options_.task},
            {"device", options_.device},
            {"precision", config_.precision},
            {"threads", options_.threads},
            {"shards", context_.device.is_cpu() ? config_.shards : 1},
            {"matrix_product_gflops", peak},
            {"rows", rows}};
  }

 private:
  static void Quiet(std::int64_t /*done*/, std::int64_t /*total*/) {}

  model::TrialFile MakeData() const {
    WriteRandomTrials(SpecOf(options_.task), kTrials, folder_ / "trials.h5");
    return model::TrialFile(folder_ / "trials.h5");
  }

  double Peak() const { return MatrixPeakGflops(context_.device, options_.threads); }

  void Encode() {
    hidden_ = std::make_unique<model::HiddenCache>(
        folder_ / "hidden", pictures_, samples_.frames.size(), config_.hidden_variants,
        [this](int slot, int variant) {
          return context_.ViewOf(samples_.frames[static_cast<std::size_t>(slot)].trial, variant);
        },
        context_.networks.encoder, config_.network, options_.threads, context_.device, Quiet);
    context_.hidden = hidden_.get();
  }

  // What the heads see of a trial, on average: all its cached frames, and the states that T
  // imagines from a random segment to its end.
  double StatesOfTrial() const {
    double states = 0;
    for (const model::TrialSample& trial : samples_.trials) {
      if (config_.imagined_share < 1) ++states;
      if (config_.imagined_share > 0) states += 0.5 * (trial.segments + 1);
    }
    for (const model::SegmentSample& segment : samples_.segments) {
      if (config_.imagined_share < 1) states += 1.0 + static_cast<double>(segment.mids.size());
    }
    return states / static_cast<double>(samples_.trials.size());
  }

  // The first `count` steps of the stage, as training takes them; their seconds.
  double Steps(model::Stage* stage, std::int64_t count) const {
    model::StageRun run;
    run.folder = folder_ / stage->name();
    run.key = "bench";
    run.seed = config_.seed;
    run.shards = config_.shards;
    run.threads = options_.threads;
    run.checkpoint_seconds = static_cast<double>(kNever);
    run.device = context_.device;
    run.mixed_precision = config_.precision == "mixed";
    run.stop_after = count;
    run.quiet = true;  // of stages without an end there is nothing to tell
    return model::RunStage(stage, run).seconds;
  }

  json Measure(model::Stage* stage, const Unit& unit, const model::StageConfig& by_default) const {
    const auto batch = static_cast<double>(stage->config().batch);
    double forward = 0, backward = 0, first_seconds = 0;
    {
      const MultiplyAdds counter;
      first_seconds = Steps(stage, kCounted);
      forward = static_cast<double>(MultiplyAdds::forward()) / (kCounted * batch);
      backward = static_cast<double>(MultiplyAdds::backward()) / (kCounted * batch);
    }
    const auto steps = std::max<std::int64_t>(
        kCounted, static_cast<std::int64_t>(options_.seconds / first_seconds * kCounted));
    const double processor = ProcessSeconds();
    const double seconds = Steps(stage, steps);
    const double samples_per_s = static_cast<double>(steps) * batch / seconds;
    return {{"stage", stage->name()},
            {"batch", stage->config().batch},
            {"sample", unit.sample},
            {"samples_per_s", samples_per_s},
            {"images_per_sample", unit.images},
            {"images_per_s", samples_per_s * unit.images},
            {"forward", forward},
            {"backward", backward},
            {"gflops", 2e-9 * (forward + backward) * samples_per_s},
            {"busy_cores", (ProcessSeconds() - processor) / seconds},
            {"iterations", by_default.iterations},
            {"minutes", static_cast<double>(by_default.iterations) * batch / samples_per_s / 60},
            {"steps", steps},
            {"seconds", seconds}};
  }

  cli::BenchTrainOptions options_;
  TemporaryFolder folder_;
  model::TrainConfig defaults_, config_;
  model::TrialFile file_;
  model::SampleSet samples_;
  model::PictureCache pictures_;
  std::unique_ptr<model::HiddenCache> hidden_;
  model::TrainContext context_;
};

}  // namespace

json BenchTraining(const cli::BenchTrainOptions& options) {
  // Refused before anything is made.
  model::TrainConfig defaults = TrainConfigOf(cli::TaskOf(options.task));
  defaults.precision = options.precision;
  model::Validate(defaults);
  defaults = model::Resolved(defaults, options.device);
  model::DeviceNamed(options.device);
  at::set_num_threads(1);  // shards are the parallelism, as in model::Trainer
  return Bench(options, defaults).Run();
}

}  // namespace prospect::tools

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include "model/engine.h"
#include "model/training/batches.h"
#include "model/training/export.h"
#include "model/training/frozen_decoder.h"
#include "model/training/picture_stages.h"
#include "model/training/scores.h"
#include "model/training/stage.h"
#include "model/training/trainer.h"
#include "model/training/transform_stages.h"
#include "model/training/variants.h"
#include "model/weights.h"
#include "model/weights_error.h"
#include "tests/unit/model/made_trial.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

constexpr int kTrials = 30;

TrainConfig TinyConfig() {
  TrainConfig config;
  config.precision = "float32";  // on every processor
  config.network.image_width = config.network.image_height = 32;
  config.network.num_actions = 3;
  config.mids_per_segment = 1;
  config.checkpoint_seconds = 0;  // at every row of the curves
  config.classifier = {10, 4, 1e-3};
  config.encoder_decoder = {30, 2, 1e-3};
  config.transform_hidden = {10, 4, 1e-3};
  config.transform_image = {4, 4, 1e-3};
  config.heads = {10, 4, 1e-3};
  return config;
}

std::string Bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(in)), {});
}

class TrainingTest : public ::testing::Test {
 protected:
  TrainingTest() {
    std::vector<std::string> parts;
    for (int seed = 0; seed < kTrials; ++seed) {
      parts.push_back(folder_ / (std::to_string(seed) + ".h5"));
      Trial trial = MadeTrial(static_cast<std::uint64_t>(seed), 2, seed % 3 == 0, 6, 32);
      trial.image_noise = 0.01;
      WriteTrialFile(parts.back(), trial);
    }
    PackTrialFiles(parts, folder_ / "all.h5");
  }
  TrainOptions Options(const std::string& out) const {
    TrainOptions options;
    options.task = "made";
    options.data = folder_ / "all.h5";
    options.folder = folder_ / out;
    return options;
  }
  TestFolder folder_;
};

TEST_F(TrainingTest, AWholeRunGivesWeightsThatLoadAndIsSkippedTheSecondTime) {
  TrainConfig config = TinyConfig();
  config.encoder_decoder.iterations = 5;
  config.augment = "dihedral";
  config.hidden_variants = 2;
  config.done_weight = 0.1;
  config.landmark_weight = 1.0;
  Trainer trainer(config, Options("run"));
  trainer.Run();
  RoundToHalf(trainer.context().networks);
  const nlohmann::json scores = ComputeScores(trainer.context(), trainer.file(), 2);
  const std::string path = ExportWeights(trainer, scores);
  EXPECT_EQ(LoadEngine(path, 1)->info().task, "made");
  EXPECT_TRUE(scores["pictures"]["x2"].contains("copy_mae_changed"));
  EXPECT_GT(scores["pictures"]["x1"]["noise_floor"].get<double>(), 0.001);
  EXPECT_EQ(scores["f"]["imagined"]["samples"], scores["value"]["imagined"]["samples"]);
  // Two actions a trial, so imagined states are those after one transform and those after two.
  const auto samples = [&](const char* head, const char* kind) {
    return scores[head][kind]["samples"].get<int>();
  };
  EXPECT_EQ(samples("value", "after_one") + samples("value", "after_two"),
            samples("value", "imagined"));
  EXPECT_EQ(samples("p", "after_one"), 3 * samples("value", "after_one"));
  EXPECT_EQ(samples("q", "after_one"), samples("value", "after_one"));
  EXPECT_EQ(samples("q", "after_two"), 0) << "nothing was done after the second";

  const std::string first = Bytes(path);
  const std::string curves = Bytes(folder_ / "run/curves.csv");
  Trainer again(config, Options("run"));
  again.Run();
  RoundToHalf(again.context().networks);
  ExportWeights(again, scores);
  EXPECT_EQ(Bytes(path), first);
  EXPECT_EQ(Bytes(folder_ / "run/curves.csv"), curves) << "nothing was trained again";

  config.heads.iterations = 11;  // only the heads depend on it
  Trainer changed(config, Options("run"));
  changed.Run();
  const std::string after = Bytes(folder_ / "run/curves.csv");
  EXPECT_NE(after.find("heads,11,"), std::string::npos);
  EXPECT_EQ(after.find("heads,10,"), std::string::npos);
  EXPECT_NE(after.find("encoder-decoder,5,"), std::string::npos);
}

TEST_F(TrainingTest, ABundleIsAllButCAndIsScoredWithoutIt) {
  TrainConfig config = TinyConfig();
  config.encoder_decoder.iterations = 2;
  Trainer trainer(config, Options("run"));
  trainer.Run();
  RoundToHalf(trainer.context().networks);
  const nlohmann::json scores = ComputeScores(trainer.context(), trainer.file(), 2);
  const std::string weights = ExportWeights(trainer, scores);
  BundleWeights(weights, folder_ / "bundle");
  EXPECT_EQ(Bytes(folder_ / "bundle/made.safetensors"), Bytes(weights));
  Trainer bundled(config, Options("run"));
  bundled.Load(folder_ / "bundle/made.safetensors");
  EXPECT_FALSE(bundled.context().networks.has_classifier);
  nlohmann::json again = ComputeScores(bundled.context(), bundled.file(), 2);
  EXPECT_FALSE(again["labels"]["x1"].contains("first"));
  nlohmann::json expected = scores;
  for (const char* step : {"x1", "x2"}) {
    expected["labels"][step].erase("first");
    expected["labels"][step].erase("real_first");
  }
  EXPECT_EQ(again, expected);
}

TEST_F(TrainingTest, HeldOutTrialsAloneAreEnoughForScores) {
  TrainConfig config = TinyConfig();
  TrainOptions options = Options("run");
  options.command = "how it was made";
  Trainer trainer(config, options);
  trainer.Run();
  RoundToHalf(trainer.context().networks);
  const nlohmann::json scores = ComputeScores(trainer.context(), trainer.file(), 2);
  const std::string weights = ExportWeights(trainer, scores);
  EXPECT_EQ(ReadWeights(weights).metadata["command"], "how it was made");
  EXPECT_EQ(
      ReadWeights(weights).metadata["trial_seeds"],
      (std::vector<std::uint64_t>{trainer.file().seeds().front(), trainer.file().seeds().back()}));

  options = Options("scored");
  options.data = folder_ / "test.h5";
  PackChoice choice;
  choice.split = Split::kTest;
  PackTrialFiles({Options("run").data}, options.data, choice);
  EXPECT_THROW(Trainer(config, options), DataError) << "nothing to train on";
  options.score_only = true;
  Trainer scored(config, options);
  scored.Load(weights);
  const nlohmann::json again = ComputeScores(scored.context(), scored.file(), 2);
  EXPECT_EQ(again["pictures"], scores["pictures"]);
  EXPECT_EQ(again["labels"], scores["labels"]);
  for (const char* head : {"value", "f", "p", "q"}) {
    for (const char* of : {"brier", "area_under_roc", "balanced_accuracy_at_half"}) {
      EXPECT_EQ(again[head]["after_one"][of], scores[head]["after_one"][of]) << head << " " << of;
    }
  }
  EXPECT_EQ(again["value"]["real"]["threshold"], 0.5);
}

TEST_F(TrainingTest, WithoutFailuresTheWeightsPredictPicturesOnly) {
  std::vector<std::string> parts;
  for (int seed = 0; seed < kTrials; ++seed) {
    if (seed % 3 != 0) parts.push_back(folder_ / (std::to_string(seed) + ".h5"));  // those succeed
  }
  TrainOptions options = Options("pictures");
  options.data = folder_ / "successes.h5";
  PackTrialFiles(parts, options.data);
  TrainConfig config = TinyConfig();
  config.classifier.iterations = 0;
  config.heads_need_failures = true;
  EXPECT_THROW(Trainer(config, options), std::invalid_argument) << "lambda needs C";
  config.lambda = 0;
  Trainer trainer(config, options);
  trainer.Run();
  RoundToHalf(trainer.context().networks);
  const nlohmann::json scores = ComputeScores(trainer.context(), trainer.file(), 1);
  EXPECT_FALSE(scores.contains("labels"));
  EXPECT_FALSE(scores.contains("plan"));
  EXPECT_GT(scores["pictures"]["x2"]["ssim"].get<double>(), -1.0);
  const std::string path = ExportWeights(trainer, scores);
  EXPECT_FALSE(std::filesystem::exists(ClassifiersPath(path)));
  EXPECT_FALSE(HasModule(ReadWeights(path), "value"));

  const auto engine = LoadEngine(path, 1);
  EXPECT_FALSE(engine->info().judges);
  const std::vector<std::uint8_t> picture(32 * 32 * 3, 90);
  const Hidden h = engine->Encode(picture);
  const Prediction answer = engine->Expand({{h, h, 1}}).front();
  EXPECT_EQ(answer.h.size(), h.size());
  EXPECT_EQ(answer.q, std::vector<float>(3, 0.0F));
  EXPECT_EQ(engine->Decode({answer.h}).front().size(), picture.size());
  try {
    LoadSearchEngine(path, 1);
    FAIL() << "a search must not begin";
  } catch (const WeightsError& error) {
    EXPECT_NE(std::string(error.what()).find("made.safetensors: these weights predict pictures"),
              std::string::npos)
        << error.what();
  }
  BundleWeights(path, folder_ / "bundle");
  Trainer bundled(config, options);
  bundled.Load(folder_ / "bundle/made.safetensors");
  EXPECT_EQ(ComputeScores(bundled.context(), bundled.file(), 1), scores);

  TrainConfig all = TinyConfig();  // and on with trials that fail
  options.data = folder_ / "all.h5";
  options.folder = folder_ / "judging";
  options.from = path;
  Trainer judging(all, options);
  judging.Run();
  EXPECT_TRUE(judging.context().networks.has_heads);
}

TEST(LinkedSteps, GrowEvenlyOverTheFirstHalf) {
  TrainConfig config;
  config.linked_steps = 3;
  config.transform_hidden.iterations = 60;
  EXPECT_EQ(LinkedSteps(config, 0), 3);
  config.linked_from = 1;
  const std::vector<std::pair<int, int>> steps = {{0, 1},  {9, 1},  {10, 2}, {19, 2},
                                                  {20, 3}, {30, 3}, {59, 3}};
  for (const auto& [iteration, linked] : steps) EXPECT_EQ(LinkedSteps(config, iteration), linked);
}

TEST_F(TrainingTest, WeightsWithoutTsExtrasAreGoneOnFromWithThem) {
  TrainConfig config = TinyConfig();
  config.heads.iterations = 0;
  Trainer plain(config, Options("plain"));
  plain.Run();
  TrainOptions options = Options("extended");
  options.from = ExportWeights(plain, nlohmann::json::object());
  config.network.transform_action = "scale_and_shift";
  config.network.transform_mask = true;
  config.linked_steps = 3, config.linked_from = 1;
  Trainer extended(config, options);
  extended.Run();
  const auto engine = LoadEngine(ExportWeights(extended, nlohmann::json::object()), 1);
  const Hidden h = engine->Encode(std::vector<std::uint8_t>(32 * 32 * 3, 90));
  EXPECT_EQ(engine->Expand({{h, h, 1}}).front().h.size(), h.size());
}

TEST_F(TrainingTest, WeightsGoneOnFromKeepTheirClassifiersAndTellTheirHistory) {
  TrainConfig config = TinyConfig();
  config.heads.iterations = 0;
  TrainOptions beginning = Options("first");
  beginning.command = "first";
  Trainer first(config, beginning);
  first.Run();
  std::string weights = ExportWeights(first, nlohmann::json::object());
  config.classifier.iterations = config.encoder_decoder.iterations =
      config.transform_hidden.iterations = 0;
  for (const char* folder : {"second", "third"}) {
    TrainOptions options = Options(folder);
    options.from = weights;
    options.command = folder;
    Trainer trainer(config, options);
    trainer.Run();
    EXPECT_TRUE(trainer.context().networks.has_classifier) << folder;
    weights = ExportWeights(trainer, nlohmann::json::object());
    Networks networks(config.network);
    LoadNetworks(weights, &networks);
    EXPECT_TRUE(networks.has_second_classifier) << folder;
  }
  const nlohmann::json metadata = ReadWeights(weights).metadata;
  EXPECT_EQ(metadata["command"], "third");
  ASSERT_EQ(metadata["history"].size(), 2U);
  EXPECT_EQ(metadata["history"][0]["command"], "first");
  EXPECT_EQ(metadata["history"][0]["train"]["classifier"]["iterations"], 10);
  EXPECT_EQ(metadata["history"][1]["command"], "second");
}

// Variants are compared on one encoder: T alone begins from random weights.
TEST_F(TrainingTest, AStageMayBeginAfreshFromWeightsThatDoNotFitIt) {
  TrainConfig config = TinyConfig();
  config.heads.iterations = 0;
  Trainer plain(config, Options("plain"));
  plain.Run();
  TrainOptions options = Options("afresh");
  options.from = ExportWeights(plain, nlohmann::json::object());
  config.encoder_decoder.iterations = config.transform_hidden.iterations =
      config.transform_image.iterations = 0;
  const auto trained = [&] {
    auto trainer = std::make_unique<Trainer>(config, options);
    trainer->Run();
    return trainer;
  };
  const auto same = trained();
  options.fresh = {"transform"};
  const auto afresh = trained();
  config.network.skip = false;
  const auto other = trained();
  options.fresh.clear();
  EXPECT_THROW(trained(), WeightsError) << "T has another shape";

  const auto weight = [](const Trainer& trainer, bool encoder) {
    const Networks& n = trainer.context().networks;
    return (encoder ? n.encoder->parameters() : n.transform->parameters()).front();
  };
  for (const Trainer* trainer : {afresh.get(), other.get()}) {
    EXPECT_TRUE(weight(*trainer, true).equal(weight(*same, true)));
    EXPECT_FALSE(weight(*trainer, false).equal(weight(*same, false)));
  }
  options.fresh = {"encoder"};
  EXPECT_THROW(trained(), std::invalid_argument) << "the stage is encoder-decoder";
}

// The original fed the first action twice.
TEST_F(TrainingTest, TheSecondStepIsOfTheSecondAction) {
  const TrialFile file(folder_ / "all.h5");
  TrainConfig config = TinyConfig();
  config.hidden_variants = 1;
  const SampleSet samples = ReadSamples(file, 1);
  const PictureCache pictures(folder_ / "p", file, samples, [](std::int64_t, std::int64_t) {});
  const TrainContext context{config,      samples, pictures, nullptr, Networks(config.network),
                             torch::kCPU, {}};
  const TrialSample& trial = samples.trials.front();
  const int segment = trial.first_segment;
  const ChainBatch batch(
      context, {MakeChain(context, segment, context.segment(segment).start, 2, false)}, {0});
  const int a1 = context.segment(segment).action, a2 = context.segment(segment + 1).action;
  ASSERT_NE(a1, a2);
  EXPECT_EQ(batch.Actions(0).item<int64_t>(), a1);
  EXPECT_EQ(batch.Actions(1).item<int64_t>(), a2);
  EXPECT_EQ(batch.GoalSlots(1).front(), context.segment(segment + 1).goal);

  Trainer trainer(config, Options("run"));
  trainer.Run();
  const std::string path =
      ExportWeights(trainer, ComputeScores(trainer.context(), trainer.file(), 1));
  const auto engine = LoadEngine(path, 1);
  const std::vector<std::uint8_t> seen(32 * 32 * 3, 90);
  const Hidden h0 = engine->Encode(seen);
  const Hidden h1 = engine->Expand({{h0, h0, a1}}).front().h;
  std::set<std::vector<std::uint8_t>> futures;
  for (int next = 0; next < 3; ++next) {
    const Hidden h2 = engine->Expand({{h0, h1, next}}).front().h;
    futures.insert(engine->Decode({h2}).front());
  }
  EXPECT_EQ(futures.size(), 3U) << "one picture for each second action";
}

TEST_F(TrainingTest, AnotherTaskOrShapeIsRefused) {
  TrainOptions options = Options("run");
  options.task = "navigation";
  EXPECT_THROW(Trainer(TinyConfig(), options), DataError);
  TrainConfig config = TinyConfig();
  config.network.num_actions = 4;
  EXPECT_THROW(Trainer(config, Options("run")), DataError);
  options = Options("run");
  options.stages = {"everything"};
  EXPECT_THROW(Trainer(TinyConfig(), options), std::invalid_argument);
}

/// Trains the encoder in `folder`, as if killed after `stop` iterations if that is not negative.
class EncoderRun {
 public:
  EncoderRun(const TrainConfig& config, const std::string& data, const std::string& folder)
      : file_(data),
        samples_(ReadSamples(file_, config.mids_per_segment)),
        pictures_(folder + ".pictures", file_, samples_, [](std::int64_t, std::int64_t) {}),
        context_{config, samples_, pictures_, nullptr, MakeNetworks(config), torch::kCPU, {}} {
    context_.mean_picture = pictures_.Mean(samples_.FramesOf(Split::kTrain));
    run_.folder = folder;
    run_.key = "key";
    run_.checkpoint_seconds = 0;
    stage_ = MakeEncoderDecoderStage(context_);
  }
  bool Run(std::int64_t stop) {
    run_.stop_after = stop;
    return RunStage(stage_.get(), run_).finished;
  }
  StageRun& run() { return run_; }
  /// How far the light gains of the first pictures are from 1, as a mean.
  double GainError() {
    const torch::NoGradGuard no_grad;
    const torch::Tensor x = pictures_.Get({0, 1, 2, 3, 4, 5, 6, 7});
    Networks networks = context_.networks;
    const torch::Tensor decoded = networks.decoder->forward(networks.encoder->forward(x));
    return (LightGain(x, decoded) - 1).abs().mean().item<double>();
  }
  torch::Tensor Weights() const {
    std::vector<torch::Tensor> all;
    for (const auto& [name, module] : stage_->modules()) {
      for (const torch::Tensor& tensor : module->parameters())
        all.push_back(tensor.detach().flatten());
    }
    return torch::cat(all).clone();
  }

 private:
  static Networks MakeNetworks(const TrainConfig& config) {
    torch::manual_seed(1);
    return Networks(config.network);
  }
  TrialFile file_;
  SampleSet samples_;
  PictureCache pictures_;
  TrainContext context_;
  StageRun run_;
  std::unique_ptr<Stage> stage_;
};

// Pictures compared in their own light leave the decoder's scale open; the gain's weight closes it.
TEST_F(TrainingTest, TheGainsWeightFixesTheDecodersScale) {
  TrainConfig config = TinyConfig();
  config.encoder_decoder = {120, 2, 2e-3};
  config.network.dropout = 0.0;
  const auto gain_error = [&](double weight, const std::string& folder) {
    config.gain_weight = weight;
    EncoderRun run(config, folder_ / "all.h5", folder_ / folder);
    run.Run(-1);
    return run.GainError();
  };
  const double free = gain_error(0.0, "free"), fixed = gain_error(5.0, "fixed");
  EXPECT_LT(fixed, 0.5 * free) << free;
}

TEST_F(TrainingTest, AKilledRunContinuesToTheSameWeights) {
  const TrainConfig config = TinyConfig();
  EncoderRun whole(config, folder_ / "all.h5", folder_ / "whole");
  EXPECT_TRUE(whole.Run(-1));
  EncoderRun killed(config, folder_ / "all.h5", folder_ / "killed");
  EXPECT_FALSE(killed.Run(28));  // the checkpoint is of iteration 25
  EncoderRun resumed(config, folder_ / "all.h5", folder_ / "killed");
  EXPECT_TRUE(resumed.Run(-1));
  EXPECT_TRUE(resumed.Weights().equal(whole.Weights()));
  EXPECT_EQ(Bytes(folder_ / "killed/curves.csv"), Bytes(folder_ / "whole/curves.csv"));
}

/// While one lives, this process can make no file longer than `bytes`: as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, handler_);
  }

 private:
  sighandler_t handler_;
  rlimit before_{};
};

std::string WhyItEnds(EncoderRun& run) {
  try {
    run.Run(-1);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "it did not";
}

TEST_F(TrainingTest, AFullDiskEndsTheRunAndLosesNoCheckpoint) {
  const TrainConfig config = TinyConfig();
  EncoderRun begun(config, folder_ / "all.h5", folder_ / "run");
  EXPECT_FALSE(begun.Run(26));
  const std::string checkpoint = folder_ / "run/stage-encoder-decoder.checkpoint";
  const std::string kept = Bytes(checkpoint);
  ASSERT_GT(kept.size(), 10000u);
  {
    EncoderRun run(config, folder_ / "all.h5", folder_ / "run");
    const FileSizeLimit limit(8000);
    const std::string why = WhyItEnds(run);
    EXPECT_NE(why.find("run/stage-encoder-decoder"), std::string::npos) << why;
    EXPECT_NE(why.find("space on the disk"), std::string::npos) << why;
    EXPECT_EQ(why.find('\n'), std::string::npos) << why;
  }
  EXPECT_EQ(Bytes(checkpoint), kept);
  {
    EncoderRun run(config, folder_ / "all.h5", folder_ / "run");
    const std::string curves = Bytes(folder_ / "run/curves.csv");
    const FileSizeLimit limit(20);
    EXPECT_NE(WhyItEnds(run).find("curves.csv"), std::string::npos);
    EXPECT_EQ(Bytes(folder_ / "run/curves.csv"), curves);
  }
  EncoderRun resumed(config, folder_ / "all.h5", folder_ / "run");
  EXPECT_TRUE(resumed.Run(-1)) << "with room again it goes on";
  EXPECT_FALSE(std::filesystem::exists(checkpoint));
}

std::vector<torch::Tensor> CopyOf(const torch::nn::Module& module) {
  std::vector<torch::Tensor> all;
  for (const torch::Tensor& tensor : module.parameters()) all.push_back(tensor.detach().clone());
  return all;
}

void Restore(const std::vector<torch::Tensor>& copy, torch::nn::Module* module) {
  const torch::NoGradGuard no_grad;
  for (std::size_t i = 0; i < copy.size(); ++i) module->parameters()[i].copy_(copy[i]);
}

bool Same(const std::vector<torch::Tensor>& a, const std::vector<torch::Tensor>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const torch::Tensor& x, const torch::Tensor& y) { return x.equal(y); });
}

// T's stage on pictures, run and killed at will.
class AdversarialRun {
 public:
  AdversarialRun(const TrainContext& context, std::string folder)
      : context_(context), folder_(std::move(folder)) {}

  bool Run(std::int64_t stop_after) const {
    StageRun run;
    run.folder = folder_;
    run.key = "key";
    run.checkpoint_seconds = 0;
    run.stop_after = stop_after;
    return RunStage(MakeTransformImageStage(context_).get(), run).finished;
  }

 private:
  const TrainContext& context_;
  std::string folder_;
};

// The Wasserstein judge, whose turns and optimizer differ from all other stages'.
TEST_F(TrainingTest, AnAdversaryTrainsAndItsKilledRunContinuesToTheSameWeights) {
  TrainConfig config = TinyConfig();
  ApplyVariant("wgan", &config);
  config.encoder_decoder.iterations = 2;
  config.transform_image = {30, 2, 1e-3};
  config.judge_steps = 2;
  TrainOptions options = Options("wgan");
  options.stages = {"classifier", "encoder-decoder", "transform"};
  Trainer trainer(config, options);
  trainer.Run();
  torch::nn::Module* transform = trainer.context().networks.transform.ptr().get();
  const std::vector<torch::Tensor> before = CopyOf(*transform);
  const AdversarialRun whole(trainer.context(), folder_ / "whole");
  EXPECT_TRUE(whole.Run(-1));
  const std::vector<torch::Tensor> after = CopyOf(*transform);
  EXPECT_FALSE(Same(before, after));
  Restore(before, transform);
  const AdversarialRun killed(trainer.context(), folder_ / "killed");
  EXPECT_FALSE(killed.Run(28));  // the checkpoint is of iteration 25
  EXPECT_TRUE(killed.Run(-1));
  EXPECT_TRUE(Same(CopyOf(*transform), after));
  const std::string curves = Bytes(folder_ / "whole/curves.csv");
  EXPECT_NE(curves.find("transform-image,25,judge,"), std::string::npos);
  EXPECT_NE(curves.find("transform-image,25,l1_x2,"), std::string::npos);
}

// The parts of T's loss on pictures of one batch, by name.
std::map<std::string, double> PartsOfFirstBatch(const TrainContext& context) {
  const std::unique_ptr<Stage> stage = MakeTransformImageStage(context);
  const LossParts loss = stage->Loss(0, 0, 1);
  EXPECT_TRUE(loss.loss.requires_grad());
  return {loss.parts.begin(), loss.parts.end()};
}

TEST_F(TrainingTest, OnlyActionsThatTookPlaceArePaintedAndOnlySuccessesClassified) {
  TrainConfig config = TinyConfig();
  config.repeat_last = false;
  TrainOptions options = Options("run");
  options.stages = {"classifier", "encoder-decoder", "transform"};
  Trainer trainer(config, options);
  trainer.Run();
  const auto both = PartsOfFirstBatch(trainer.context());
  EXPECT_GT(both.at("l1_x1"), 0);
  EXPECT_GT(both.at("l1_x2"), 0);
  EXPECT_GT(both.at("classifier"), 0);

  SampleSet samples = trainer.context().samples;
  TrainContext failed{config,
                      samples,
                      trainer.context().pictures,
                      trainer.context().hidden,
                      trainer.context().networks,
                      torch::kCPU,
                      trainer.context().mean_picture};
  double halves = 0;  // each row's own share, whichever rows are classified beside it
  for (const std::size_t odd : {0, 1}) {
    for (std::size_t i = 0; i < samples.segments.size(); ++i) {
      samples.segments[i].succeeded =
          i % 2 == odd && trainer.context().samples.segments[i].succeeded;
    }
    halves += PartsOfFirstBatch(failed).at("classifier");
  }
  EXPECT_NEAR(halves, both.at("classifier"), 1e-5);
  for (SegmentSample& segment : samples.segments) segment.succeeded = false;
  const auto failures = PartsOfFirstBatch(failed);
  EXPECT_EQ(failures.at("l1_x2"), both.at("l1_x2"));
  EXPECT_EQ(failures.at("classifier"), 0);

  // Every trial as if it ended with the action that a chain begins with.
  samples.trials.clear();
  for (int i = 0; i < static_cast<int>(samples.segments.size()); ++i) {
    samples.trials.push_back(trainer.context().trial(trainer.context().segment(i).trial));
    samples.trials.back().first_segment = i;
    samples.trials.back().segments = 1;
    samples.segments[static_cast<std::size_t>(i)].trial = i;
  }
  const auto singles = PartsOfFirstBatch(failed);
  EXPECT_EQ(singles.at("l1_x1"), both.at("l1_x1"));
  EXPECT_EQ(singles.at("l1_x2"), 0);
}

TEST(FrozenDecoder, PaintsAsTheDecoderDoesAndEachPictureAsIfAlone) {
  const TrainConfig config = TinyConfig();
  torch::manual_seed(3);
  Decoder decoder(config.network);
  decoder->eval();
  const FrozenDecoder frozen(decoder, config.network);
  const torch::NoGradGuard no_grad;
  const torch::Tensor h = torch::rand({3, 8, 4, 4});
  const torch::Tensor pictures = frozen(h);
  EXPECT_LT((pictures - decoder->forward(h)).abs().max().item<float>(), 1e-4F);
  EXPECT_TRUE(frozen(h.narrow(0, 1, 1)).equal(pictures.narrow(0, 1, 1)));
}

TEST_F(TrainingTest, EncoderAndDecoderLearnOnWithTheTransformIfAsked) {
  TrainConfig config = TinyConfig();
  config.encoder_decoder.iterations = 2;
  config.lambda = 0;
  TrainOptions options = Options("run");
  options.stages = {"encoder-decoder", "transform"};
  Trainer frozen(config, options);
  frozen.Run();
  config.finetune = true;
  Trainer tuned(config, options);
  tuned.Run();
  const Networks& a = frozen.context().networks;
  const Networks& b = tuned.context().networks;
  EXPECT_FALSE(Same(CopyOf(*a.encoder), CopyOf(*b.encoder)));
  EXPECT_FALSE(Same(CopyOf(*a.decoder), CopyOf(*b.decoder)));
  options.stages.insert("heads");  // they look at what the tuned encoder says
  Trainer again(config, options);
  again.Run();
  const SampleSet& samples = again.context().samples;
  const std::vector<int> slot = {samples.trials[0].first};
  Networks networks = again.context().networks;
  const torch::NoGradGuard no_grad;
  const torch::Tensor h = networks.encoder->forward(again.context().pictures.Get(slot));
  EXPECT_TRUE(h.allclose(again.context().hidden->Get(slot, {0}), 1e-4, 1e-5));
}

TEST_F(TrainingTest, ThreadsDoNotChangeTheResult) {
  TrainConfig config = TinyConfig();
  config.encoder_decoder.iterations = 5;
  EncoderRun two(config, folder_ / "all.h5", folder_ / "two");
  two.Run(-1);
  EncoderRun one(config, folder_ / "all.h5", folder_ / "one");
  one.run().threads = 1;
  one.Run(-1);
  EXPECT_TRUE(one.Weights().equal(two.Weights()));
}

TEST_F(TrainingTest, ADamagedCheckpointStartsAnew) {
  TrainConfig config = TinyConfig();
  config.encoder_decoder.iterations = 5;
  std::filesystem::create_directories(folder_ / "run");
  std::ofstream(folder_ / "run/stage-encoder-decoder.checkpoint") << "damaged";
  EncoderRun run(config, folder_ / "all.h5", folder_ / "run");
  EXPECT_TRUE(run.Run(-1));
}

TEST_F(TrainingTest, TheEncoderLearnsItsPictures) {
  TrainConfig config = TinyConfig();
  config.encoder_decoder = {100, 4, 2e-3};
  config.network.dropout = 0.0;
  EncoderRun run(config, folder_ / "all.h5", folder_ / "run");
  run.Run(-1);
  std::ifstream curves(folder_ / "run/curves.csv");
  std::string line;
  double first = -1, last = -1;
  while (std::getline(curves, line)) {
    if (line.find(",l1,") == std::string::npos) continue;
    last = std::stod(line.substr(line.rfind(',') + 1));
    if (first < 0) first = last;
  }
  EXPECT_LT(last, 0.6 * first);
}

}  // namespace
}  // namespace prospect::model

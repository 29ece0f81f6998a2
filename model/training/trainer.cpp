#include "model/training/trainer.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "base/atomic_file.h"
#include "base/hash.h"
#include "base/quiet.h"
#include "model/training/export.h"
#include "model/training/heads_stage.h"
#include "model/training/picture_stages.h"
#include "model/training/progress.h"
#include "model/training/stage.h"
#include "model/training/time_budget.h"
#include "model/training/transform_stages.h"
#include "model/weights.h"

namespace prospect::model {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Only what a result depends on goes into its key, so that changing the heads does not train the
/// encoder anew.
std::string KeyOf(const json& inputs) { return base::HexText(base::HashText(inputs.dump())); }

json PictureNetwork(const NetworkConfig& c) {
  return {c.image_width, c.image_height, c.hidden_channels, c.dropout, c.activation};
}

json TransformNetwork(const NetworkConfig& c) {
  json all = {c.num_actions, c.skip, c.transform_extra_stages};
  if (c.bottleneck != NetworkConfig().bottleneck) all.push_back(c.bottleneck);
  if (c.transform_dropout >= 0) all.push_back(c.transform_dropout);
  if (c.transform_action != NetworkConfig().transform_action) all.push_back(c.transform_action);
  if (c.transform_mask) all.push_back("mask");
  return all;
}

json HeadNetwork(const NetworkConfig& c) { return {c.head_dropout, c.heads}; }

const std::set<std::string> kStages = {"classifier", "second-classifier", "encoder-decoder",
                                       "transform", "heads"};

void RequireKnownStages(const std::set<std::string>& stages) {
  for (const std::string& stage : stages) {
    if (!kStages.contains(stage)) {
      throw std::invalid_argument("stage '" + stage +
                                  "': known are classifier, second-classifier, encoder-decoder, "
                                  "transform and heads");
    }
  }
}

/// Said before hours of training rather than after them.
void RequireParts(const TrialFile& file, const SampleSet& samples,
                  const std::vector<Split>& parts) {
  for (const Split split : parts) {
    if (!samples.TrialsOf(split).empty()) continue;
    throw DataError(file.path() + ": none of its " + std::to_string(file.size()) +
                    " trials is in the " + SplitName(split) +
                    " part, which is a function of a trial's seed: add trials of other seeds");
  }
}

/// Whether the training part has something for V, Q, p and f to learn from: a trial or an action
/// that failed.
bool HasFailures(const SampleSet& samples) {
  for (const int t : samples.TrialsOf(Split::kTrain)) {
    if (!samples.trials[static_cast<std::size_t>(t)].succeeded) return true;
  }
  for (const int s : samples.SegmentsOf(Split::kTrain)) {
    if (!samples.segments[static_cast<std::size_t>(s)].succeeded) return true;
  }
  return false;
}

/// The stage that first trains a network.
std::string StageOf(const std::string& network) {
  if (network == "encoder" || network == "decoder") return "encoder-decoder";
  if (network == "transform" || network == "f") return "transform";
  if (network == "second_classifier") return "second-classifier";
  return network == "classifier" ? network : "heads";
}

/// Whether a stage's networks begin from the weights that were given.
bool BeginsFrom(const TrainOptions& options, const std::string& stage) {
  return !options.from.empty() && !options.fresh.contains(stage);
}

bool TrainsHeads(const TrainConfig& config, const SampleSet& samples, const TrainOptions& options) {
  if (config.heads.iterations == 0) {
    return BeginsFrom(options, "heads") && HasModule(ReadWeights(options.from), "value");
  }
  return !config.heads_need_failures || HasFailures(samples);
}

/// Whether C and the second classifier are there: trained, or in the weights to begin from.
bool HasClassifiers(const TrainConfig& config, const TrainOptions& options) {
  const bool some = config.classifier.iterations > 0 ||
                    (BeginsFrom(options, "classifier") && ReadsLabels(ReadWeights(options.from)));
  const bool needed = config.lambda > 0 && config.transform_image.iterations > 0;
  if (!some && needed && !options.score_only) {
    throw std::invalid_argument("lambda: needs C; give classifier.iterations above 0, or lambda 0");
  }
  return some;
}

void RequireSuccess(const TrialFile& file, const SampleSet& samples) {
  const std::vector<int> trials = samples.TrialsOf(Split::kTrain);
  for (const int t : trials) {
    if (samples.trials[static_cast<std::size_t>(t)].succeeded) return;
  }
  throw DataError(file.path() + ": none of the " + std::to_string(trials.size()) +
                  " trials in its train part succeeded, so V and Q have nothing to learn: add "
                  "trials that succeed");
}

SampleSet ReadSamplesFor(const TrialFile& file, const TrainConfig& config,
                         const TrainOptions& options) {
  if (!file.shard().empty())
    throw DataError(file.path() + ": is one part of a data set: join all with ./prospect merge");
  if (!base::Quiet()) std::fprintf(stderr, "reading labels of %zu trials\n", file.size());
  SampleSet samples = ReadSamples(file, config.mids_per_segment);
  if (samples.trials.empty()) throw DataError(file.path() + ": has no trials");
  if (samples.task != options.task) {
    throw DataError(file.path() + ": holds trials of '" + samples.task + "', not of '" +
                    options.task + "'");
  }
  const NetworkConfig& n = config.network;
  if (samples.num_actions != n.num_actions || samples.width != n.image_width ||
      samples.height != n.image_height) {
    throw DataError(file.path() +
                    ": number of actions or picture size differ from the configuration");
  }
  if (options.score_only) {
    RequireParts(file, samples, {Split::kTest});
    return samples;
  }
  if (options.stages.empty()) {
    RequireParts(file, samples, {Split::kTrain, Split::kValid, Split::kTest});
  }
  const bool heads = options.stages.empty() || options.stages.contains("heads");
  if (heads && TrainsHeads(config, samples, options)) RequireSuccess(file, samples);
  return samples;
}

/// T's layers beyond the paper, as they begin where weights were trained without them.
void AddMissingExtras(const NetworkConfig& config, WeightsFile* weights) {
  Transform neutral(config);
  neutral->NeutraliseExtras();
  for (const auto& item : neutral->named_parameters()) {
    const std::string& name = item.key();
    if (!name.starts_with("modulation.") && !name.starts_with("mask.")) continue;
    weights->tensors.emplace("transform." + name, ToStored(item.value()));
  }
}

/// One network from a weights file, or from the classifiers' file beside it.
void LoadNetwork(const std::string& weights, const NetworkConfig& config, const std::string& prefix,
                 torch::nn::Module* module) {
  WeightsFile planning = ReadWeights(weights);
  if (prefix == "transform") AddMissingExtras(config, &planning);
  // Weights that predict pictures only: the judging networks begin afresh.
  if (IsHead(prefix) && !HasModule(planning, "value")) return;
  const bool classifier = prefix == "classifier" || prefix == "second_classifier";
  if (!classifier || HasModule(planning, prefix)) {
    LoadModule(planning, weights, prefix, module);
    return;
  }
  const std::string beside = ClassifiersPath(weights);
  if (!fs::exists(beside) && !ReadsLabels(planning)) return;
  const WeightsFile classifiers = ReadWeights(beside);
  // Bundled weights have no C: it begins afresh.
  if (prefix == "classifier" && !HasModule(classifiers, prefix)) return;
  LoadModule(classifiers, beside, prefix, module);
}

/// Hash of the classifiers' file beside a weights file; empty if there is none.
std::string ClassifiersHash(const std::string& weights) {
  const std::string beside = ClassifiersPath(weights);
  return fs::exists(beside) ? base::HexText(WeightsFileHash(beside)) : "";
}

// Shares of a run's time. The encoder is what all else stands on, and T is the dearest.
const std::map<std::string, double> kTimeShares = {
    {"classifier", 0.1},       {"second-classifier", 0.1}, {"encoder-decoder", 0.25},
    {"transform-hidden", 0.5}, {"transform-image", 0.05},  {"heads", 0.2}};
constexpr int kTried = 20, kTriedFirst = 3;  // iterations by which a stage's speed is measured

ProgressFn ProgressOf(const std::string& what) {
  auto line = std::make_shared<ProgressLine>(what);
  return [line](std::int64_t done, std::int64_t total) { line->Show(done, total); };
}

std::string CachePath(const TrainOptions& options, const std::string& name,
                      const std::string& key) {
  const std::string folder = options.folder + "/cache";
  fs::create_directories(folder);
  return folder + "/" + name + "-" + key;
}

}  // namespace

struct Trainer::Impl {
  TrainConfig config;
  TrainOptions options;
  TrialFile file;
  SampleSet samples;
  std::string data_hash;
  std::string data_key;
  PictureCache pictures;
  std::unique_ptr<HiddenCache> hidden;
  TrainContext context;
  std::string from_hash, from_classifiers;
  std::vector<StageSummary> stages;
  std::vector<std::string> curves;   // files, in the order of `stages`
  std::optional<TimeBudget> budget;  // where a person said how long it may take

  Impl(const TrainConfig& c, const TrainOptions& o)
      : config(Resolved(c, o.device)),
        options(o),
        file(o.data),
        samples(ReadSamplesFor(file, c, o)),
        data_hash(file.ContentHash()),
        data_key(KeyOf({"data-3", data_hash, file.PicturesHash(), c.mids_per_segment})),
        pictures(CachePath(o, "pictures", data_key), file, samples, ProgressOf("pictures")),
        context{config, samples, pictures, nullptr, Networks(c.network), DeviceNamed(o.device),
                {}} {
    if (config.landmark_weight > 0 && samples.num_landmarks > 0) {
      context.landmarks = LandmarkReadout(c.network.hidden_channels, samples.num_landmarks,
                                          LandmarkReadoutImpl::kHiddenScale);
    }
    context.networks.has_classifier = HasClassifiers(c, o);
    context.networks.has_second_classifier = context.networks.has_classifier;
    context.networks.has_heads = TrainsHeads(c, samples, o);
    context.mean_picture = pictures.Mean(samples.FramesOf(Split::kTrain)).to(context.device);
    if (!o.from.empty()) {
      from_hash = base::HexText(WeightsFileHash(o.from));
      from_classifiers = ClassifiersHash(o.from);
    }
    if (o.minutes > 0) {
      budget.emplace(o.folder + "/minutes.json", o.minutes, KeyOf({BaseKey(), config}),
                     SharesOfTime());
    }
  }

  /// Refuses weights that do not fit now rather than when their stage begins.
  static void RequireFittingWeights(const TrainConfig& config, const TrainOptions& options) {
    if (options.from.empty() || !options.stages.empty()) return;
    const Networks networks(config.network);
    for (const auto& [name, module] : networks.named()) {
      if (!BeginsFrom(options, StageOf(name))) continue;
      LoadNetwork(options.from, config.network, name, module);
    }
  }

  std::map<std::string, double> SharesOfTime() const {
    std::map<std::string, double> shares = kTimeShares;
    const auto unless = [&](bool runs, const char* stage) {
      if (!runs) shares.erase(stage);
    };
    unless(context.networks.has_classifier && config.classifier.iterations > 0, "classifier");
    unless(context.networks.has_classifier && config.classifier.iterations > 0,
           "second-classifier");
    unless(config.transform_hidden.iterations > 0, "transform-hidden");
    unless(config.transform_image.iterations > 0, "transform-image");
    unless(context.networks.has_heads && config.heads.iterations > 0, "heads");
    return shares;
  }

  /// Sets a stage's iterations by the time that it may take. Trying how fast it is spoils its
  /// networks, which `initialise` makes anew.
  void Budget(const std::string& name, StageConfig* stage,
              const std::function<std::unique_ptr<Stage>()>& make,
              const std::function<void()>& initialise) {
    if (!budget || stage->iterations == 0) return;
    stage->iterations = budget->Iterations(name, [&] {
      StageRun run = RunOf("speed-of-" + name, "speed");
      run.quiet = true;
      run.checkpoint_seconds = 1e9;
      for (const int tried : {kTriedFirst, kTried}) {
        run.stop_after = tried;
        initialise();
        stage->iterations = std::max<std::int64_t>(stage->iterations, tried + 1);
        const std::unique_ptr<Stage> trial = make();
        if (tried == kTried) return RunStage(trial.get(), run).seconds / tried;
        RunStage(trial.get(), run);
      }
      return 0.0;
    });
    initialise();
    if (!base::Quiet()) {
      std::fprintf(stderr, "%-18s %8lld iterations fit into its time\n", name.c_str(),
                   static_cast<long long>(stage->iterations));
    }
  }

  bool Wants(const std::string& stage) const {
    return options.stages.empty() || options.stages.contains(stage);
  }

  /// First weights of one network: from the weights file asked for, or random, by the network's own
  /// seed.
  void Initialise(const std::string& prefix, torch::nn::Module* module) const {
    InitialiseFresh(prefix, module);
    if (!BeginsFrom(options, StageOf(prefix))) return;
    module->to(torch::kCPU);
    LoadNetwork(options.from, config.network, prefix, module);
    module->to(context.device);
  }

  void InitialiseFresh(const std::string& prefix, torch::nn::Module* module) const {
    torch::manual_seed(base::Mix64(config.seed ^ base::HashText(prefix)));
    module->to(torch::kCPU);
    InitialiseGlorot(module);
    module->to(context.device);
  }

  std::string WeightsFolder() const {
    return options.variant.empty() ? options.folder : options.folder + "/" + options.variant;
  }

  StageRun RunOf(const std::string& stage, const std::string& key) const {
    StageRun run;
    run.folder = options.folder + "/stages/" + stage + "-" + key;
    run.key = key;
    run.seed = config.seed;
    run.shards = config.shards;
    run.threads = options.threads;
    run.mixed_precision = config.precision == "mixed";
    run.checkpoint_seconds = config.checkpoint_seconds;
    run.device = context.device;
    return run;
  }

  /// A stage's key says that its networks did not begin from the weights that were given.
  void AddFresh(const std::string& stage, json* inputs) const {
    if (options.fresh.contains(stage)) inputs->push_back("fresh");
  }
  std::string BaseKey() const {
    return KeyOf({"base-1", data_key, config.seed, config.shards, options.device, from_hash});
  }
  std::string ClassifierKey(const std::string& stage) const {
    json inputs = {"classifier-3",
                   BaseKey(),
                   PictureNetwork(config.network),
                   config.network.num_actions,
                   config.network.head_dropout,
                   config.augment,
                   config.landmark_weight,
                   config.classifier};
    if (!from_classifiers.empty()) inputs.push_back(from_classifiers);
    AddFresh(stage, &inputs);
    return KeyOf(inputs);
  }
  std::string EncoderKey() const {
    json inputs = {"encoder-3",           BaseKey(),    PictureNetwork(config.network),
                   config.augment,        config.focus, config.landmark_weight,
                   config.encoder_decoder};
    if (config.gain_weight > 0) inputs.push_back(config.gain_weight);
    AddFresh("encoder-decoder", &inputs);
    return KeyOf(inputs);
  }
  std::string HiddenKey() const {
    return KeyOf({"hidden-2", EncoderKey(), config.hidden_variants});
  }
  std::string FinetunedKey() const {
    return KeyOf({"hidden-2", TransformKey(), config.hidden_variants});
  }
  std::string TransformHiddenKey() const {
    json inputs = {"transform-hidden-2",
                   HiddenKey(),
                   TransformNetwork(config.network),
                   HeadNetwork(config.network),
                   config.transform_hidden,
                   config.linked_steps,
                   config.repeat_last,
                   config.start_share,
                   config.done_weight};
    if (config.linked_from > 0) inputs.push_back(config.linked_from);
    AddFresh("transform", &inputs);
    return KeyOf(inputs);
  }
  std::string TransformKey() const {
    json inputs = {"transform-image-2", TransformHiddenKey(),
                   config.lambda > 0 ? ClassifierKey("classifier") : "no classifier",
                   config.transform_image, config.lambda};
    if (config.picture_weight != 1.0) inputs.push_back(config.picture_weight);
    if (config.adversary != "none") {
      inputs.insert(inputs.end(),
                    {config.adversary, config.judge_steps, config.judge_clip, config.judge_rate});
    }
    if (config.finetune) inputs.push_back("finetune");
    return KeyOf(inputs);
  }
  std::string HeadsKey() const {
    json inputs = {"heads-1", TransformKey(), config.heads, config.imagined_share};
    if (!samples.successors.empty()) inputs.push_back(samples.successors);
    if (config.inside_weight != 1.0) inputs.push_back(config.inside_weight);
    if (config.labels != "paper") inputs.push_back(config.labels);
    AddFresh("heads", &inputs);
    return KeyOf(inputs);
  }

  /// Trains a stage, or, where it was not asked for but is needed by a later one, loads its result.
  void TrainOrLoad(const std::string& wanted_by, Stage* stage, const std::string& key) {
    const StageRun run = RunOf(stage->name(), key);
    const StageOutcome outcome = Wants(wanted_by) ? RunStage(stage, run) : LoadFinished(stage, run);
    if (!outcome.finished) {
      throw std::invalid_argument("stage '" + wanted_by +
                                  "' has not been trained from these inputs in " + options.folder +
                                  "; ask for it, too");
    }
    stages.push_back(
        {stage->name(), stage->config().iterations, stage->config().batch, outcome.seconds});
    curves.push_back(run.folder + "/curves.csv");
  }

  /// The curves of all stages of this run as one file.
  void JoinCurves() const {
    std::string text = "stage,iteration,name,value\n";
    for (const std::string& path : curves) {
      std::ifstream in(path);
      std::string line;
      std::getline(in, line);  // the heading
      while (std::getline(in, line)) text += line + "\n";
    }
    base::WriteFile(WeightsFolder() + "/curves.csv", text);
  }

  void TrainClassifier(const std::string& name, Classifier classifier) {
    const auto initialise = [&] {
      Initialise(name == "classifier" ? "classifier" : "second_classifier", classifier.ptr().get());
    };
    initialise();
    if (name == "classifier") {  // the second one is trained as long
      Budget(
          name, &config.classifier, [&] { return MakeClassifierStage(context, classifier, name); },
          initialise);
    }
    TrainOrLoad(name, MakeClassifierStage(context, classifier, name).get(), ClassifierKey(name));
  }

  void InitialiseEncoder() {
    Initialise("encoder", context.networks.encoder.ptr().get());
    Initialise("decoder", context.networks.decoder.ptr().get());
    if (context.landmarks) InitialiseFresh("landmarks", context.landmarks.ptr().get());
  }

  void TrainEncoder() {
    InitialiseEncoder();
    Budget(
        "encoder-decoder", &config.encoder_decoder,
        [&] { return MakeEncoderDecoderStage(context); }, [&] { InitialiseEncoder(); });
    TrainOrLoad("encoder-decoder", MakeEncoderDecoderStage(context).get(), EncoderKey());
  }

  void Encode(const std::string& key) {
    const NetworkConfig& n = config.network;
    hidden = std::make_unique<HiddenCache>(
        CachePath(options, "hidden", key), pictures, samples.frames.size(), config.hidden_variants,
        [this](int slot, int variant) {
          return context.ViewOf(samples.frames[static_cast<std::size_t>(slot)].trial, variant);
        },
        context.networks.encoder, n, options.threads, context.device, ProgressOf("encodings"));
    context.hidden = hidden.get();
  }

  void InitialiseTransform() {
    Initialise("transform", context.networks.transform.ptr().get());
    Initialise("f", context.networks.f.ptr().get());
  }

  void TrainTransform() {
    InitialiseTransform();
    Budget(
        "transform-hidden", &config.transform_hidden,
        [&] { return MakeTransformHiddenStage(context); }, [&] { InitialiseTransform(); });
    Budget(
        "transform-image", &config.transform_image,
        [&] { return MakeTransformImageStage(context); }, [&] { InitialiseTransform(); });
    if (config.transform_hidden.iterations > 0) {
      TrainOrLoad("transform", MakeTransformHiddenStage(context).get(), TransformHiddenKey());
    }
    if (config.transform_image.iterations > 0) {
      TrainOrLoad("transform", MakeTransformImageStage(context).get(), TransformKey());
    }
  }

  /// f goes on from where T's training left it.
  void ReloadTransform() {
    const bool image = config.transform_image.iterations > 0;
    if (!image && config.transform_hidden.iterations == 0) return InitialiseTransform();
    const std::unique_ptr<Stage> stage =
        image ? MakeTransformImageStage(context) : MakeTransformHiddenStage(context);
    LoadFinished(stage.get(), RunOf(stage->name(), image ? TransformKey() : TransformHiddenKey()));
  }

  void InitialiseHeads() {
    for (const auto& [name, module] : context.networks.named()) {
      if (name == "value" || name == "q" || name == "p") Initialise(name, module);
    }
  }

  void TrainHeads() {
    InitialiseHeads();
    Budget(
        "heads", &config.heads, [&] { return MakeHeadsStage(context); },
        [&] {
          InitialiseHeads();
          ReloadTransform();
        });
    TrainOrLoad("heads", MakeHeadsStage(context).get(), HeadsKey());
  }
};

Trainer::Trainer(const TrainConfig& config, const TrainOptions& options) {
  Validate(config);
  RequireKnownStages(options.stages);
  RequireKnownStages(options.fresh);
  DeviceNamed(options.device);  // before anything is read
  Impl::RequireFittingWeights(config, options);
  fs::create_directories(options.folder + "/" + options.variant);
  at::set_num_threads(1);  // shards are the parallelism; see RunStage
  impl_ = std::make_unique<Impl>(config, options);
}

Trainer::~Trainer() = default;

// Later stages need what earlier ones made, whether or not those were asked for.
void Trainer::Run() {
  Impl& run = *impl_;
  Networks& networks = run.context.networks;
  const bool labels = networks.has_classifier;
  const bool heads = run.Wants("heads") && networks.has_heads;
  const bool transform = run.Wants("transform") || heads;
  if (run.Wants("heads") && !heads) {
    std::fprintf(stderr, "V, Q, p and f are left out: %s\n",
                 run.config.heads.iterations == 0 ? "heads.iterations is 0"
                                                  : "nothing failed in the training part");
  }
  const bool judges =
      transform && run.config.transform_image.iterations > 0 && run.config.lambda > 0;
  if ((run.Wants("classifier") && labels) || judges)
    run.TrainClassifier("classifier", networks.classifier);
  if (run.Wants("second-classifier") && labels) {
    run.TrainClassifier("second-classifier", networks.second_classifier);
  }
  if (run.Wants("encoder-decoder") || transform) run.TrainEncoder();
  if (transform) {
    run.Encode(run.HiddenKey());
    run.TrainTransform();
    if (run.config.finetune && heads) run.Encode(run.FinetunedKey());
  }
  if (heads) run.TrainHeads();
  run.JoinCurves();
  networks.SetTraining(false);
}

void Trainer::Load(const std::string& weights) {
  LoadNetworks(weights, &impl_->context.networks);
  impl_->context.networks.To(impl_->context.device);
}

const TrainContext& Trainer::context() const { return impl_->context; }
const TrialFile& Trainer::file() const { return impl_->file; }
const std::string& Trainer::data_hash() const { return impl_->data_hash; }
const TrainOptions& Trainer::options() const { return impl_->options; }
std::string Trainer::weights_folder() const { return impl_->WeightsFolder(); }
const std::vector<StageSummary>& Trainer::stages() const { return impl_->stages; }

}  // namespace prospect::model

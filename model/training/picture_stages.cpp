#include "model/training/picture_stages.h"

#include "model/training/batches.h"

namespace prospect::model {
namespace {

class ClassifierStage : public Stage {
 public:
  ClassifierStage(const TrainContext& context, Classifier classifier, std::string name)
      : context_(context), classifier_(std::move(classifier)), name_(std::move(name)) {
    for (const int s : context.samples.SegmentsOf(Split::kTrain)) {
      if (context.segment(s).succeeded) segments_.push_back(s);
    }
    if (segments_.empty()) throw DataError("no training segment succeeded; collect more trials");
    if (context.landmarks) {
      readout_ = LandmarkReadout(ClassifierImpl::kMapChannels, context.samples.num_landmarks, 1.0);
      readout_->to(context.device);
    }
  }
  std::string name() const override { return name_; }
  const StageConfig& config() const override { return context_.config.classifier; }
  std::vector<std::pair<std::string, torch::nn::Module*>> modules() const override {
    std::vector<std::pair<std::string, torch::nn::Module*>> all = {
        {"classifier", classifier_.ptr().get()}};
    if (readout_) all.emplace_back("landmarks", readout_.ptr().get());
    return all;
  }

  LossParts Loss(std::int64_t iteration, int shard, int shards) override {
    CounterRandom random = BatchRandom(context_.config, name_, iteration, shard);
    std::vector<int> slots, actions;
    for (int i = 0; i < ShardSize(config().batch, shard, shards); ++i) {
      const SegmentSample& segment = context_.segment(segments_[static_cast<std::size_t>(
          random.Below(static_cast<std::int64_t>(segments_.size())))]);
      slots.push_back(segment.goal);
      actions.push_back(segment.action);
    }
    const int view = DrawView(context_.config, &random);
    const torch::Tensor x =
        View(context_.pictures.Get(slots), view).contiguous().to(context_.device);
    const torch::Tensor map = classifier_->Map(x);
    const torch::Tensor logits = classifier_->Judge(map);
    const torch::Tensor target = ActionTensor(actions, context_.device);
    const torch::Tensor loss = torch::cross_entropy_loss(logits, target);
    const double right = logits.argmax(1).eq(target).to(torch::kFloat).mean().item<double>();
    LossParts result{loss, {{"cross_entropy", loss.item<double>()}, {"accuracy", right}}};
    if (readout_) AddLandmarks(map, slots, view, &result);
    return result;
  }

 private:
  void AddLandmarks(const torch::Tensor& map, const std::vector<int>& slots, int view,
                    LossParts* result) {
    const std::vector<int> views(slots.size(), view);
    const torch::Tensor maps =
        LandmarkMaps(context_.samples, slots, views, map.size(2), map.size(3)).to(context_.device);
    const torch::Tensor loss = LandmarkLoss(readout_->forward(map), maps).mean();
    result->loss = result->loss + context_.config.landmark_weight * loss;
    result->parts.emplace_back("landmarks", loss.item<double>());
  }

  const TrainContext& context_;
  Classifier classifier_;
  LandmarkReadout readout_{nullptr};
  std::string name_;
  std::vector<int> segments_;
};

class EncoderDecoderStage : public Stage {
 public:
  explicit EncoderDecoderStage(const TrainContext& context)
      : context_(context), slots_(context.samples.FramesOf(Split::kTrain)) {
    if (slots_.empty()) throw DataError("the training part is empty; collect more trials");
  }
  std::string name() const override { return "encoder-decoder"; }
  const StageConfig& config() const override { return context_.config.encoder_decoder; }
  std::vector<std::pair<std::string, torch::nn::Module*>> modules() const override {
    std::vector<std::pair<std::string, torch::nn::Module*>> all = {
        {"encoder", context_.networks.encoder.ptr().get()},
        {"decoder", context_.networks.decoder.ptr().get()}};
    if (context_.landmarks) all.emplace_back("landmarks", context_.landmarks.ptr().get());
    return all;
  }

  LossParts Loss(std::int64_t iteration, int shard, int shards) override {
    CounterRandom random = BatchRandom(context_.config, name(), iteration, shard);
    std::vector<int> slots;
    for (int i = 0; i < ShardSize(config().batch, shard, shards); ++i) {
      slots.push_back(
          slots_[static_cast<std::size_t>(random.Below(static_cast<std::int64_t>(slots_.size())))]);
    }
    torch::Tensor x = context_.pictures.Get(slots).to(context_.device);
    torch::Tensor weights = PixelWeights(x, context_.mean_picture, context_.config.focus);
    const int view = DrawView(context_.config, &random);
    x = View(x, view).contiguous();
    weights = MovedAsView(weights, view);
    Networks networks = context_.networks;
    const torch::Tensor h = networks.encoder->forward(x);
    const torch::Tensor decoded = networks.decoder->forward(h);
    const torch::Tensor error = (decoded * LightGain(x, decoded) - x).abs();
    const torch::Tensor loss = (error * weights).mean();
    LossParts result{loss, {{"loss", loss.item<double>()}, {"l1", error.mean().item<double>()}}};
    if (context_.config.gain_weight > 0) AddGainLoss(x, decoded, &result);
    if (context_.landmarks) AddLandmarks(h, slots, view, &result);
    return result;
  }

 private:
  /// The light of a scene cannot be seen in h, so this drives the decoder to one scale for all.
  void AddGainLoss(const torch::Tensor& x, const torch::Tensor& decoded, LossParts* result) const {
    const torch::Tensor gain =
        (x * decoded).sum({1, 2, 3}) / decoded.square().sum({1, 2, 3}).clamp_min(1e-6);
    const torch::Tensor loss = gain.clamp_min(1e-3).log().square().mean();
    result->loss = result->loss + context_.config.gain_weight * loss;
    result->parts.emplace_back("gain", loss.item<double>());
  }

  void AddLandmarks(const torch::Tensor& h, const std::vector<int>& slots, int view,
                    LossParts* result) const {
    LandmarkReadout readout = context_.landmarks;
    const std::vector<int> views(slots.size(), view);
    const torch::Tensor maps =
        LandmarkMaps(context_.samples, slots, views, h.size(2), h.size(3)).to(context_.device);
    const torch::Tensor loss = LandmarkLoss(readout->forward(h), maps).mean();
    result->loss = result->loss + context_.config.landmark_weight * loss;
    result->parts.emplace_back("landmarks", loss.item<double>());
  }

  const TrainContext& context_;
  std::vector<int> slots_;
};

}  // namespace

std::unique_ptr<Stage> MakeClassifierStage(const TrainContext& context, Classifier classifier,
                                           const std::string& name) {
  return std::make_unique<ClassifierStage>(context, std::move(classifier), name);
}

std::unique_ptr<Stage> MakeEncoderDecoderStage(const TrainContext& context) {
  return std::make_unique<EncoderDecoderStage>(context);
}

}  // namespace prospect::model

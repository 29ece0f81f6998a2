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
  }
  std::string name() const override { return name_; }
  const StageConfig& config() const override { return context_.config.classifier; }
  std::vector<std::pair<std::string, torch::nn::Module*>> modules() const override {
    return {{"classifier", classifier_.ptr().get()}};
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
    const torch::Tensor x =
        Dihedral(context_.pictures.Get(slots), DrawTurn(context_.config, &random)).contiguous();
    const torch::Tensor logits = classifier_->forward(x.to(context_.device));
    const torch::Tensor target = ActionTensor(actions, context_.device);
    const torch::Tensor loss = torch::cross_entropy_loss(logits, target);
    const double right = logits.argmax(1).eq(target).to(torch::kFloat).mean().item<double>();
    return {loss, {{"cross_entropy", loss.item<double>()}, {"accuracy", right}}};
  }

 private:
  const TrainContext& context_;
  Classifier classifier_;
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
    return {{"encoder", context_.networks.encoder.ptr().get()},
            {"decoder", context_.networks.decoder.ptr().get()}};
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
    const int turn = DrawTurn(context_.config, &random);
    x = Dihedral(x, turn).contiguous();
    weights = Dihedral(weights, turn);
    Networks networks = context_.networks;
    const torch::Tensor error = (networks.decoder->forward(networks.encoder->forward(x)) - x).abs();
    const torch::Tensor loss = (error * weights).mean();
    return {loss, {{"loss", loss.item<double>()}, {"l1", error.mean().item<double>()}}};
  }

 private:
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

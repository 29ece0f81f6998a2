#include "model/training/transform_stages.h"

#include <algorithm>
#include <memory>

#include "base/hash.h"
#include "model/training/adversary.h"
#include "model/training/batches.h"
#include "model/training/frozen_decoder.h"

namespace prospect::model {
namespace {

/// What both of T's stages share: the chains they train on, and the loss of f on T's states.
class TransformStage : public Stage {
 public:
  explicit TransformStage(const TrainContext& context)
      : context_(context), segments_(context.samples.SegmentsOf(Split::kTrain)) {
    if (segments_.empty()) throw DataError("the training part has no actions; collect more trials");
    if (!context.landmarks) return;
    for (torch::Tensor& tensor : context.landmarks->parameters()) tensor.set_requires_grad(false);
  }
  std::vector<std::pair<std::string, torch::nn::Module*>> modules() const override {
    return {{"transform", context_.networks.transform.ptr().get()},
            {"f", context_.networks.f.ptr().get()}};
  }

 protected:
  ChainBatch Draw(CounterRandom* random, int size, int steps) const {
    std::vector<Chain> chains;
    std::vector<int> variants;
    for (int i = 0; i < size; ++i) {
      const int s = segments_[static_cast<std::size_t>(
          random->Below(static_cast<std::int64_t>(segments_.size())))];
      chains.push_back(MakeChain(context_, s, DrawStart(context_.segment(s), random), steps,
                                 context_.config.repeat_last));
      variants.push_back(static_cast<int>(random->Below(context_.config.hidden_variants)));
    }
    return {context_, std::move(chains), std::move(variants)};
  }

  /// Binary cross-entropy of f on an imagined state, whose gradient also reaches T (done_weight).
  torch::Tensor DoneLoss(const torch::Tensor& h0, const torch::Tensor& h, const ChainBatch& batch,
                         int step) const {
    Networks networks = context_.networks;
    const torch::Tensor logit = networks.f->forward(h0, h, batch.Actions(step)).squeeze(1);
    return (torch::binary_cross_entropy_with_logits(logit, batch.Succeeded(step), {}, {},
                                                    at::Reduction::None) *
            batch.Weights(step))
        .mean();
  }

  /// How far the landmarks read from T's output are from where the goal picture has them.
  torch::Tensor LandmarkError(const torch::Tensor& h, const ChainBatch& batch, int step) const {
    LandmarkReadout readout = context_.landmarks;
    const torch::Tensor maps =
        LandmarkMaps(context_.samples, batch.GoalSlots(step), batch.Views(), h.size(2), h.size(3))
            .to(context_.device);
    return (LandmarkLoss(readout->forward(h), maps) * batch.Weights(step)).mean();
  }

  const TrainContext& context_;

 private:
  int DrawStart(const SegmentSample& segment, CounterRandom* random) const {
    if (segment.mids.empty() || random->Uniform() < context_.config.start_share)
      return segment.start;
    return segment.mids[static_cast<std::size_t>(
        random->Below(static_cast<std::int64_t>(segment.mids.size())))];
  }

  std::vector<int> segments_;
};

class TransformHiddenStage : public TransformStage {
 public:
  using TransformStage::TransformStage;
  std::string name() const override { return "transform-hidden"; }
  const StageConfig& config() const override { return context_.config.transform_hidden; }

  LossParts Loss(std::int64_t iteration, int shard, int shards) override {
    CounterRandom random = BatchRandom(context_.config, name(), iteration, shard);
    const int steps = LinkedSteps(context_.config, iteration);
    const ChainBatch batch = Draw(&random, ShardSize(config().batch, shard, shards), steps);
    const torch::Tensor h0 = batch.First();
    torch::Tensor h = batch.Start();
    torch::Tensor loss = torch::zeros({}, h.options());
    torch::Tensor done = torch::zeros({}, h.options());
    torch::Tensor places = torch::zeros({}, h.options());
    LossParts result;
    Networks networks = context_.networks;
    for (int k = 0; k < batch.steps(); ++k) {
      h = networks.transform->forward(h0, h, batch.Actions(k));
      const torch::Tensor error =
          ((h - batch.Goal(k)).abs().mean({1, 2, 3}) * batch.Weights(k)).mean();
      if (k < LinkedSteps(context_.config, 0))  // the same names every time
        result.parts.emplace_back("l1_h" + std::to_string(k + 1), error.item<double>());
      loss = loss + error;
      if (context_.landmarks) places = places + LandmarkError(h, batch, k);
      if (context_.config.done_weight > 0) done = done + DoneLoss(h0, h, batch, k);
    }
    result.parts.emplace_back("done", done.item<double>());
    result.parts.emplace_back("landmarks", places.item<double>());
    result.loss =
        loss + context_.config.done_weight * done + context_.config.landmark_weight * places;
    return result;
  }
};

/// Some rows of a batch. A picture costs more than T does, so only those are painted, and only
/// those classified, that a loss has a weight for; what a loss is stays the same.
struct Rows {
  std::vector<std::int64_t> of_batch;

  bool none() const { return of_batch.empty(); }
  template <typename T>
  std::vector<T> Of(const std::vector<T>& all) const {
    std::vector<T> some;
    for (const std::int64_t row : of_batch) some.push_back(all[static_cast<std::size_t>(row)]);
    return some;
  }
  torch::Tensor Of(const torch::Tensor& all) const {
    if (static_cast<std::int64_t>(of_batch.size()) == all.size(0)) return all;
    return all.index_select(0, torch::tensor(of_batch).to(all.device()));
  }
};

/// Those where `weights` [B] is not zero.
Rows RowsThatCount(const torch::Tensor& weights) {
  Rows rows;
  const torch::Tensor on_cpu = weights.cpu();
  for (std::int64_t i = 0; i < on_cpu.size(0); ++i) {
    if (on_cpu[i].item<float>() != 0) rows.of_batch.push_back(i);
  }
  return rows;
}

class TransformImageStage : public TransformStage {
 public:
  explicit TransformImageStage(const TrainContext& context) : TransformStage(context) {
    Freeze(context.networks.classifier.ptr().get());
    if (!context.config.finetune) Freeze(context.networks.decoder.ptr().get());
    if (!context.config.finetune && context.device.is_cpu()) {
      frozen_decoder_ =
          std::make_unique<FrozenDecoder>(context.networks.decoder, context.config.network);
    }
    if (context.config.adversary != "none") MakeAdversary();
  }
  std::string name() const override { return "transform-image"; }
  const StageConfig& config() const override { return context_.config.transform_image; }
  std::vector<std::pair<std::string, torch::nn::Module*>> modules() const override {
    auto all = TransformStage::modules();
    if (context_.config.finetune) {
      all.emplace_back("encoder", context_.networks.encoder.ptr().get());
      all.emplace_back("decoder", context_.networks.decoder.ptr().get());
    }
    if (adversary_) all.emplace_back("judge", adversary_->judge().ptr().get());
    return all;
  }
  std::string optimizer() const override {
    return context_.config.adversary == "wgan" ? "rmsprop" : "adam";
  }
  double RateOf(const std::string& module) const override {
    return module == "judge" ? context_.config.judge_rate : 1.0;
  }
  void AfterStep() override {
    if (adversary_) adversary_->AfterStep();
  }

  LossParts Loss(std::int64_t iteration, int shard, int shards) override {
    CounterRandom random = BatchRandom(context_.config, name(), iteration, shard);
    const ChainBatch batch =
        Draw(&random, ShardSize(config().batch, shard, shards), context_.config.linked_steps);
    LossParts result;
    const bool learns = !adversary_ || adversary_->GeneratorsTurn(iteration);
    std::vector<PicturePair> pictures;
    {
      const torch::AutoGradMode gradients(learns);
      pictures = Imagine(batch, &result);
    }
    if (adversary_) AddJudgement(batch, pictures, learns, &random, &result);
    return result;
  }

 private:
  /// What T imagined of one step, what it should have, and the weights of pixels.
  struct PicturePair {
    torch::Tensor imagined, real, focus;
  };

  static void Freeze(torch::nn::Module* module) {
    module->eval();
    for (torch::Tensor& tensor : module->parameters()) tensor.set_requires_grad(false);
  }

  /// Encodings of pictures: from the cache while the encoder is frozen, else made anew.
  torch::Tensor First(const ChainBatch& batch) const {
    return context_.config.finetune ? Encoded(batch.FirstSlots(), batch) : batch.First();
  }
  torch::Tensor Start(const ChainBatch& batch) const {
    return context_.config.finetune ? Encoded(batch.StartSlots(), batch) : batch.Start();
  }
  torch::Tensor Encoded(const std::vector<int>& slots, const ChainBatch& batch) const {
    Encoder encoder = context_.networks.encoder;
    const torch::Tensor x = View(context_.pictures.Get(slots), batch.Views());
    return encoder->forward(x.to(context_.device));
  }

  void MakeAdversary() {
    torch::manual_seed(base::Mix64(context_.config.seed ^ base::HashText("judge")));
    adversary_ = std::make_unique<Adversary>(context_.config);
    adversary_->judge()->to(context_.device);
  }

  /// The loss without an adversary, and the pictures of the first two steps.
  std::vector<PicturePair> Imagine(const ChainBatch& batch, LossParts* result) const {
    const torch::Tensor h0 = First(batch);
    torch::Tensor h = Start(batch);
    const torch::Tensor gain = Gain(h0, batch);
    result->loss = torch::zeros({}, h.options());
    Networks networks = context_.networks;
    std::vector<PicturePair> pictures;
    for (int k = 0; k < batch.steps(); ++k) {
      h = networks.transform->forward(h0, h, batch.Actions(k));
      if (k < 2) pictures.push_back(AddPictureLoss(h, gain, batch, k, result));
      if (context_.config.done_weight > 0) {
        result->loss = result->loss + context_.config.done_weight * DoneLoss(h0, h, batch, k);
      }
      if (context_.landmarks) {
        result->loss = result->loss + context_.config.landmark_weight * LandmarkError(h, batch, k);
      }
    }
    return pictures;
  }

  /// Rows that have a second step; all of them where none has.
  torch::Tensor JudgedRows(const ChainBatch& batch) const {
    const torch::Tensor rows = batch.Weights(1).nonzero().flatten();
    if (rows.numel() > 0) return rows;
    return torch::arange(static_cast<std::int64_t>(batch.size()), rows.options());
  }

  void AddJudgement(const ChainBatch& batch, const std::vector<PicturePair>& pictures, bool learns,
                    CounterRandom* random, LossParts* result) const {
    const torch::Tensor rows = JudgedRows(batch);
    const auto chosen = [&rows](const torch::Tensor& all) { return all.index_select(0, rows); };
    const torch::Tensor action = chosen(batch.Actions(1));
    const JudgedPair real{chosen(pictures[0].real), chosen(pictures[1].real), action};
    const JudgedPair imagined{chosen(pictures[0].imagined), chosen(pictures[1].imagined), action};
    const torch::Tensor judges = adversary_->JudgesLoss(real, imagined, random);
    torch::Tensor generators;
    {
      const torch::AutoGradMode gradients(learns);
      generators = adversary_->GeneratorsLoss(imagined);
    }
    result->loss = learns ? result->loss + generators + judges : judges;
    result->parts.emplace_back("judge", judges.item<double>());
    result->parts.emplace_back("found_out", generators.item<double>());
  }

  /// The light of each chain's first picture.
  torch::Tensor Gain(const torch::Tensor& h0, const ChainBatch& batch) const {
    const torch::NoGradGuard no_grad;
    Decoder decoder = context_.networks.decoder;
    const torch::Tensor seen = View(context_.pictures.Get(batch.FirstSlots()), batch.Views());
    return LightGain(seen.to(context_.device),
                     frozen_decoder_ ? (*frozen_decoder_)(h0) : decoder->forward(h0));
  }

  /// A judge looks at all rows.
  PicturePair AddPictureLoss(const torch::Tensor& h, const torch::Tensor& gain,
                             const ChainBatch& batch, int step, LossParts* result) const {
    const torch::Tensor weights = batch.Weights(step);
    const Rows rows = RowsThatCount(adversary_ ? torch::ones_like(weights) : weights);
    PicturePair pair;
    double l1 = 0;
    if (!rows.none()) {
      pair =
          Paint(rows.Of(h), rows.Of(gain), rows.Of(batch.GoalSlots(step)), rows.Of(batch.Views()));
      const torch::Tensor error = (pair.imagined - pair.real).abs();
      const torch::Tensor share = rows.Of(weights) / static_cast<double>(batch.size());
      const torch::Tensor loss = ((error * pair.focus).mean({1, 2, 3}) * share).sum();
      result->loss = result->loss + context_.config.picture_weight * loss;
      l1 = (error.mean({1, 2, 3}) * share).sum().item<double>();
    }
    result->parts.emplace_back("l1_x" + std::to_string(step + 1), l1);
    if (step == 1 && context_.config.lambda > 0) {
      AddClassifierLoss(pair.imagined, rows, batch, step, result);
    }
    return pair;
  }

  PicturePair Paint(const torch::Tensor& h, const torch::Tensor& gain,
                    const std::vector<int>& goals, const std::vector<int>& views) const {
    Decoder decoder = context_.networks.decoder;
    const torch::Tensor raw = context_.pictures.Get(goals).to(context_.device);
    return {decoder->forward(h) * gain, View(raw, views),
            MovedAsView(PixelWeights(raw, context_.mean_picture, context_.config.focus), views)};
  }

  /// `x`: the pictures of the rows `painted`.
  void AddClassifierLoss(const torch::Tensor& x, const Rows& painted, const ChainBatch& batch,
                         int step, LossParts* result) const {
    Classifier classifier = context_.networks.classifier;
    const torch::Tensor weights = painted.Of(batch.Weights(step) * batch.Succeeded(step));
    const Rows rows = RowsThatCount(weights);
    double mean = 0;
    if (!rows.none()) {
      const torch::Tensor entropy = torch::cross_entropy_loss(
          classifier->forward(rows.Of(x)), rows.Of(painted.Of(batch.Actions(step))), {},
          at::Reduction::None);
      const torch::Tensor loss =
          (entropy * rows.Of(weights)).sum() / static_cast<double>(batch.size());
      result->loss = result->loss + context_.config.lambda * loss;
      mean = loss.item<double>();
    }
    result->parts.emplace_back("classifier", mean);
  }

  std::unique_ptr<FrozenDecoder> frozen_decoder_;  ///< null: it learns, or is on a GPU
  std::unique_ptr<Adversary> adversary_;
};

}  // namespace

int LinkedSteps(const TrainConfig& config, std::int64_t iteration) {
  if (config.linked_from == 0) return config.linked_steps;
  const std::int64_t growing = config.linked_steps - config.linked_from + 1;
  const std::int64_t half = std::max<std::int64_t>(1, config.transform_hidden.iterations / 2);
  return std::min<int>(config.linked_steps,
                       config.linked_from + static_cast<int>(growing * iteration / half));
}

std::unique_ptr<Stage> MakeTransformHiddenStage(const TrainContext& context) {
  return std::make_unique<TransformHiddenStage>(context);
}

std::unique_ptr<Stage> MakeTransformImageStage(const TrainContext& context) {
  return std::make_unique<TransformImageStage>(context);
}

}  // namespace prospect::model

#include "model/training/heads_stage.h"

#include "model/training/batches.h"

namespace prospect::model {
namespace {

torch::Tensor Entropy(const torch::Tensor& logits, const torch::Tensor& labels) {
  return torch::binary_cross_entropy_with_logits(logits, labels, {}, {}, at::Reduction::None);
}

/// Mean of `values` where `mask` is not 0.
torch::Tensor MaskedMean(const torch::Tensor& values, const torch::Tensor& mask) {
  return (values * mask).sum() / mask.sum().clamp_min(1.0);
}

class HeadsStage : public Stage {
 public:
  explicit HeadsStage(const TrainContext& context)
      : context_(context), trials_(context.samples.TrialsOf(Split::kTrain)) {
    if (trials_.empty()) throw DataError("the training part has no actions; collect more trials");
    context.networks.transform.ptr()->eval();
  }
  std::string name() const override { return "heads"; }
  const StageConfig& config() const override { return context_.config.heads; }
  std::vector<std::pair<std::string, torch::nn::Module*>> modules() const override {
    const Networks& n = context_.networks;
    return {{"value", n.value.ptr().get()},
            {"q", n.q.ptr().get()},
            {"p", n.p.ptr().get()},
            {"f", n.f.ptr().get()}};
  }

  LossParts Loss(std::int64_t iteration, int shard, int shards) override {
    CounterRandom random = BatchRandom(context_.config, name(), iteration, shard);
    std::vector<int> trials, variants;
    for (int i = 0; i < ShardSize(config().batch, shard, shards); ++i) {
      trials.push_back(trials_[static_cast<std::size_t>(
          random.Below(static_cast<std::int64_t>(trials_.size())))]);
      variants.push_back(static_cast<int>(random.Below(context_.config.hidden_variants)));
    }
    const double share = context_.config.imagined_share;
    LossParts result;
    result.loss = torch::zeros({}, torch::TensorOptions().device(context_.device));
    if (share < 1.0) AddReal(trials, variants, 1.0 - share, &result);
    if (share > 0.0) AddImagined(trials, variants, share, &random, &result);
    return result;
  }

 private:
  StateLabels NoLabels() const {
    const bool authors = context_.config.labels == "authors";
    return {context_.samples, authors, authors ? 1.0 : context_.config.inside_weight};
  }

  /// Every cached frame of the trials: the first, the goals, the ones inside.
  void AddReal(const std::vector<int>& trials, const std::vector<int>& variants, double weight,
               LossParts* result) const {
    StateLabels labels = NoLabels();
    std::vector<int> slots, firsts, turns;
    const auto add = [&](std::size_t i, int slot) {
      slots.push_back(slot);
      firsts.push_back(context_.trial(trials[i]).first);
      turns.push_back(variants[i]);
    };
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const TrialSample& trial = context_.trial(trials[i]);
      add(i, trial.first);
      labels.AddFirst(trials[i]);
      for (int s = trial.first_segment; s < trial.first_segment + trial.segments; ++s) {
        const SegmentSample& segment = context_.segment(s);
        add(i, segment.goal);
        labels.AddGoal(s);
        for (const int mid : segment.mids) {
          add(i, mid);
          labels.AddInside(s);
        }
      }
    }
    AddHeads(context_.hidden->Get(firsts, turns).to(context_.device),
             context_.hidden->Get(slots, turns).to(context_.device), labels, "real", weight,
             result);
  }

  /// Chains of imagined states from a random segment of each trial to its end, as the planner
  /// imagines them.
  void AddImagined(const std::vector<int>& trials, const std::vector<int>& variants, double weight,
                   CounterRandom* random, LossParts* result) const {
    std::vector<Chain> chains;
    int steps = 1;
    for (const int t : trials) {
      const TrialSample& trial = context_.trial(t);
      const int s = trial.first_segment + static_cast<int>(random->Below(trial.segments));
      const int length = trial.first_segment + trial.segments - s;
      steps = std::max(steps, length);
      chains.push_back(MakeChain(context_, s, context_.segment(s).start, length, false));
    }
    for (Chain& chain : chains) {
      chain.segments.resize(static_cast<std::size_t>(steps), chain.segments.back());
      chain.weights.resize(static_cast<std::size_t>(steps), 0.0F);
    }
    AddChains(ChainBatch(context_, chains, variants), chains, weight, result);
  }

  void AddChains(const ChainBatch& batch, const std::vector<Chain>& chains, double weight,
                 LossParts* result) const {
    Networks networks = context_.networks;
    const torch::Tensor h0 = batch.First();
    torch::Tensor h = batch.Start();
    std::vector<torch::Tensor> firsts, states;
    StateLabels labels = NoLabels();
    for (int k = 0; k < batch.steps(); ++k) {
      {
        const torch::NoGradGuard no_grad;
        h = networks.transform->forward(h0, h, batch.Actions(k));
      }
      std::vector<int> rows;
      for (std::size_t i = 0; i < chains.size(); ++i) {
        if (chains[i].weights[static_cast<std::size_t>(k)] == 0.0F) continue;
        rows.push_back(static_cast<int>(i));
        labels.AddGoal(chains[i].segments[static_cast<std::size_t>(k)]);
      }
      const torch::Tensor index = ActionTensor(rows, context_.device);
      firsts.push_back(h0.index_select(0, index));
      states.push_back(h.index_select(0, index));
    }
    AddHeads(torch::cat(firsts), torch::cat(states), labels, "imagined", weight, result);
  }

  void AddHeads(const torch::Tensor& h0, const torch::Tensor& h, const StateLabels& labels,
                const std::string& kind, double weight, LossParts* result) const {
    Networks networks = context_.networks;
    const torch::Tensor a = ActionTensor(labels.action, context_.device);
    const torch::Tensor value =
        Entropy(networks.value->forward(h), FloatTensor(labels.value, context_.device)).mean();
    const torch::Tensor done_label = FloatTensor(labels.done, context_.device);
    // f is asked only about an action; rows without one carry the first action and no weight.
    const torch::Tensor asked = a.clamp_max(context_.samples.num_actions - 1);
    const torch::Tensor done =
        MaskedMean(Entropy(networks.f->forward(h0, h, asked).squeeze(1), done_label),
                   FloatTensor(labels.f_weight, context_.device));
    const torch::Tensor p = Structure(networks.p->forward(h0, h, a), labels);
    const torch::Tensor q = Quality(networks.q->forward(h0, h, a), labels);
    result->loss = result->loss + weight * (value + done + p + q);
    result->parts.emplace_back("v_" + kind, value.item<double>());
    result->parts.emplace_back("f_" + kind, done.item<double>());
    result->parts.emplace_back("p_" + kind, p.item<double>());
    result->parts.emplace_back("q_" + kind, q.item<double>());
  }

  /// Labels of all actions [rows,actions].
  torch::Tensor OfActions(const std::vector<float>& labels) const {
    return FloatTensor(labels, context_.device).view({-1, context_.samples.num_actions});
  }

  torch::Tensor Structure(const torch::Tensor& logits, const StateLabels& labels) const {
    return MaskedMean(Entropy(logits, OfActions(labels.p)).mean(1),
                      FloatTensor(labels.structure, context_.device));
  }

  torch::Tensor Quality(const torch::Tensor& logits, const StateLabels& labels) const {
    const torch::Tensor q = OfActions(labels.q);
    return MaskedMean(Entropy(logits, q.clamp_min(0)), q.ge(0).to(torch::kFloat));
  }

  const TrainContext& context_;
  std::vector<int> trials_;
};

}  // namespace

void StateLabels::AddFirst(int trial) {
  const TrialSample& t = samples_.trials[static_cast<std::size_t>(trial)];
  const SegmentSample& first = samples_.segments[static_cast<std::size_t>(t.first_segment)];
  Add(trial, samples_.num_actions, first.action, true);
  AddDone(0.0F, 0.0F);
}

void StateLabels::AddGoal(int segment) {
  const SegmentSample& s = samples_.segments[static_cast<std::size_t>(segment)];
  const TrialSample& t = samples_.trials[static_cast<std::size_t>(s.trial)];
  const bool last = segment + 1 == t.first_segment + t.segments;
  const int next = last ? -1 : samples_.segments[static_cast<std::size_t>(segment) + 1].action;
  Add(s.trial, s.action, authors_ && last ? s.action : next, true);
  AddDone((authors_ ? !last : s.succeeded) ? 1.0F : 0.0F, 1.0F);
}

void StateLabels::AddInside(int segment) {
  const SegmentSample& s = samples_.segments[static_cast<std::size_t>(segment)];
  Add(s.trial, s.action, authors_ ? s.action : -1, authors_);
  AddDone(0.0F, inside_weight_);
}

/// `next`: the action that Q is taught about, -1 = none; `asked`: whether p is.
void StateLabels::Add(int trial, int a, int next, bool asked) {
  const TrialSample& t = samples_.trials[static_cast<std::size_t>(trial)];
  const float outcome = t.succeeded ? 1.0F : 0.0F;
  action.push_back(a);
  value.push_back(outcome);
  structure.push_back(asked ? 1.0F : 0.0F);
  for (int b = 0; b < samples_.num_actions; ++b) {
    const bool possible = authors_ ? b == next : MayFollow(samples_, t, a, b);
    p.push_back(possible ? 1.0F : 0.0F);
    q.push_back(b == next ? outcome : authors_ ? 0.0F : -1.0F);
  }
}

void StateLabels::AddDone(float is_done, float weight) {
  done.push_back(is_done);
  f_weight.push_back(weight);
}

std::unique_ptr<Stage> MakeHeadsStage(const TrainContext& context) {
  return std::make_unique<HeadsStage>(context);
}

}  // namespace prospect::model

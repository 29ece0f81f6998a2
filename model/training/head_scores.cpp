#include "model/training/head_scores.h"

#include "model/training/parallel.h"

namespace prospect::model {
namespace {

/// One trial's judgements; a fresh object per trial, so that threads need no lock.
class TrialJudge {
 public:
  TrialJudge(const ScoredSplit& split, const TrialSample& trial)
      : split_(split),
        context_(split.context()),
        networks_(context_.networks),
        trial_(trial),
        h0_(split.Hidden(trial.first)) {}

  HeadJudgements Judge() {
    JudgeReal();
    JudgeImagined();
    return std::move(result_);
  }

 private:
  const SegmentSample& Segment(int k) const { return context_.segment(trial_.first_segment + k); }
  torch::Tensor Action(int a) const { return ActionTensor({a}, context_.device); }

  float Value(const torch::Tensor& h) {
    return torch::sigmoid(networks_.value->forward(h)).item<float>();
  }
  float Done(const torch::Tensor& h, int action) {
    return torch::sigmoid(networks_.f->forward(h0_, h, Action(action))).item<float>();
  }

  void JudgeNext(const torch::Tensor& h, int action, int k_next, Judgements* p, Judgements* q) {
    const torch::Tensor allowed =
        torch::sigmoid(networks_.p->forward(h0_, h, Action(action))).to(torch::kCPU).contiguous();
    for (int a = 0; a < context_.samples.num_actions; ++a) {
      p->push_back({allowed.data_ptr<float>()[a], MayFollow(context_.samples, trial_, action, a)});
    }
    if (k_next >= trial_.segments) return;
    const torch::Tensor quality = torch::sigmoid(networks_.q->forward(h0_, h, Action(action)));
    q->push_back({quality[0][Segment(k_next).action].item<float>(), trial_.succeeded});
  }

  void JudgeReal() {
    result_.value_real.push_back({Value(h0_), trial_.succeeded});
    JudgeNext(h0_, context_.samples.num_actions, 0, &result_.p_real, &result_.q_real);
    for (int k = 0; k < trial_.segments; ++k) {
      const SegmentSample& segment = Segment(k);
      const torch::Tensor goal = split_.Hidden(segment.goal);
      result_.value_real.push_back({Value(goal), trial_.succeeded});
      result_.done_real.push_back({Done(goal, segment.action), segment.succeeded});
      for (const int mid : segment.mids) {
        result_.done_real.push_back({Done(split_.Hidden(mid), segment.action), false});
      }
      JudgeNext(goal, segment.action, k + 1, &result_.p_real, &result_.q_real);
    }
  }

  void JudgeImagined() {
    torch::Tensor h = split_.Hidden(Segment(0).start);
    float plan = 1.0F;
    result_.done_at_depth.resize(static_cast<std::size_t>(trial_.segments));
    for (int k = 0; k < trial_.segments; ++k) {
      const SegmentSample& segment = Segment(k);
      h = networks_.transform->forward(h0_, h, Action(segment.action));
      const Judgement value{Value(h), trial_.succeeded};
      const Judgement done{Done(h, segment.action), segment.succeeded};
      result_.value_imagined.push_back(value);
      if (k == 1) result_.value_after_two.push_back(value);
      result_.done_imagined.push_back(done);
      result_.done_at_depth[static_cast<std::size_t>(k)].push_back(done);
      plan *= done.score;
      if (k + 1 == trial_.segments) result_.plan.push_back({plan * value.score, trial_.succeeded});
      JudgeNext(h, segment.action, k + 1, &result_.p_imagined, &result_.q_imagined);
    }
  }

  const ScoredSplit& split_;
  const TrainContext& context_;
  Networks networks_;
  const TrialSample& trial_;
  torch::Tensor h0_;
  HeadJudgements result_;
};

void Append(const Judgements& from, Judgements* to) {
  to->insert(to->end(), from.begin(), from.end());
}

void Append(const HeadJudgements& from, HeadJudgements* to) {
  Append(from.value_real, &to->value_real);
  Append(from.value_imagined, &to->value_imagined);
  Append(from.value_after_two, &to->value_after_two);
  Append(from.done_real, &to->done_real);
  Append(from.done_imagined, &to->done_imagined);
  Append(from.p_real, &to->p_real);
  Append(from.p_imagined, &to->p_imagined);
  Append(from.q_real, &to->q_real);
  Append(from.q_imagined, &to->q_imagined);
  Append(from.plan, &to->plan);
  if (to->done_at_depth.size() < from.done_at_depth.size()) {
    to->done_at_depth.resize(from.done_at_depth.size());
  }
  for (std::size_t k = 0; k < from.done_at_depth.size(); ++k) {
    Append(from.done_at_depth[k], &to->done_at_depth[k]);
  }
}

}  // namespace

HeadJudgements JudgeHeads(const ScoredSplit& split, int threads) {
  const TrainContext& context = split.context();
  std::vector<HeadJudgements> by_trial(split.trials().size());
  ParallelPieces(static_cast<int64_t>(by_trial.size()), 4, context.device.is_cpu() ? threads : 1,
                 [&](int64_t begin, int64_t end) {
                   const torch::NoGradGuard no_grad;
                   for (int64_t i = begin; i < end; ++i) {
                     const auto at = static_cast<std::size_t>(i);
                     by_trial[at] = TrialJudge(split, context.trial(split.trials()[at])).Judge();
                   }
                 });
  HeadJudgements all;
  for (const HeadJudgements& one : by_trial) Append(one, &all);
  return all;
}

}  // namespace prospect::model

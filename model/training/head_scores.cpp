#include "model/training/head_scores.h"

#include "model/training/parallel.h"

namespace prospect::model {
namespace {

void Append(const Judgements& from, Judgements* to) {
  to->insert(to->end(), from.begin(), from.end());
}

void Append(const StateJudgements& from, StateJudgements* to) {
  Append(from.value, &to->value);
  Append(from.done, &to->done);
  Append(from.p, &to->p);
  Append(from.taken, &to->taken);
  Append(from.q, &to->q);
}

void Append(const HeadJudgements& from, HeadJudgements* to) {
  Append(from.real, &to->real);
  Append(from.imagined, &to->imagined);
  Append(from.after_one, &to->after_one);
  Append(from.after_two, &to->after_two);
  Append(from.boundary, &to->boundary);
  Append(from.boundary_after_one, &to->boundary_after_one);
  Append(from.boundary_after_two, &to->boundary_after_two);
  Append(from.plan, &to->plan);
  if (to->done_at_depth.size() < from.done_at_depth.size()) {
    to->done_at_depth.resize(from.done_at_depth.size());
  }
  for (std::size_t k = 0; k < from.done_at_depth.size(); ++k) {
    Append(from.done_at_depth[k], &to->done_at_depth[k]);
  }
}

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
    JudgeBoundaries();
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

  void JudgeNext(const torch::Tensor& h, int action, int k_next, StateJudgements* to) {
    const torch::Tensor allowed =
        torch::sigmoid(networks_.p->forward(h0_, h, Action(action))).to(torch::kCPU).contiguous();
    const float* p = allowed.data_ptr<float>();
    for (int a = 0; a < context_.samples.num_actions; ++a) {
      to->p.push_back({p[a], MayFollow(context_.samples, trial_, action, a)});
    }
    if (k_next >= trial_.segments) return;
    const int next = Segment(k_next).action;
    to->taken.push_back({p[next], true});
    const torch::Tensor quality = torch::sigmoid(networks_.q->forward(h0_, h, Action(action)));
    to->q.push_back({quality[0][next].item<float>(), trial_.succeeded});
  }

  void JudgeReal() {
    StateJudgements* real = &result_.real;
    real->value.push_back({Value(h0_), trial_.succeeded});
    JudgeNext(h0_, context_.samples.num_actions, 0, real);
    for (int k = 0; k < trial_.segments; ++k) {
      const SegmentSample& segment = Segment(k);
      const torch::Tensor goal = split_.Hidden(segment.goal);
      real->value.push_back({Value(goal), trial_.succeeded});
      real->done.push_back({Done(goal, segment.action), segment.succeeded});
      for (const int mid : segment.mids) {
        real->done.push_back({Done(split_.Hidden(mid), segment.action), false});
      }
      JudgeNext(goal, segment.action, k + 1, real);
    }
  }

  /// `h` after segment k, real or imagined.
  void JudgeEnd(const torch::Tensor& h, int k, StateJudgements* to) {
    const SegmentSample& segment = Segment(k);
    to->value.push_back({Value(h), trial_.succeeded});
    to->done.push_back({Done(h, segment.action), segment.succeeded});
    JudgeNext(h, segment.action, k + 1, to);
  }

  void JudgeBoundaries() {
    for (int k = 0; k < trial_.segments; ++k) {
      const SegmentSample& segment = Segment(k);
      JudgeEnd(split_.Hidden(segment.goal), k, &result_.boundary);
      torch::Tensor h = split_.Hidden(segment.start);
      h = networks_.transform->forward(h0_, h, Action(segment.action));
      JudgeEnd(h, k, &result_.boundary_after_one);
      if (k + 1 == trial_.segments) continue;
      h = networks_.transform->forward(h0_, h, Action(Segment(k + 1).action));
      JudgeEnd(h, k + 1, &result_.boundary_after_two);
    }
  }

  void JudgeImagined() {
    torch::Tensor h = split_.Hidden(Segment(0).start);
    float plan = 1.0F;
    result_.done_at_depth.resize(static_cast<std::size_t>(trial_.segments));
    for (int k = 0; k < trial_.segments; ++k) {
      const SegmentSample& segment = Segment(k);
      h = networks_.transform->forward(h0_, h, Action(segment.action));
      StateJudgements one;
      JudgeEnd(h, k, &one);
      Append(one, &result_.imagined);
      if (k == 0) Append(one, &result_.after_one);
      if (k == 1) Append(one, &result_.after_two);
      result_.done_at_depth[static_cast<std::size_t>(k)] = one.done;
      plan *= one.done[0].score;
      if (k + 1 == trial_.segments) {
        result_.plan.push_back({plan * one.value[0].score, trial_.succeeded});
      }
    }
  }

  const ScoredSplit& split_;
  const TrainContext& context_;
  Networks networks_;
  const TrialSample& trial_;
  torch::Tensor h0_;
  HeadJudgements result_;
};

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

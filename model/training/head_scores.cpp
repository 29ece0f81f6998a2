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

/// What the heads say of one state.
struct Said {
  float value = 0;
  float done = 0;        ///< of the action that led there; means nothing where none did
  std::vector<float> p;  ///< of all actions
  std::vector<float> q;
};

/// States, and the action that led to each; num_actions: none did.
struct States {
  std::vector<torch::Tensor> h;  ///< [1,c,Hh,Wh] each
  std::vector<int> action;

  void Add(const torch::Tensor& state, int a) {
    h.push_back(state);
    action.push_back(a);
  }
  std::size_t size() const { return h.size(); }
};

/// One trial's judgements; a fresh object per trial, so that threads need no lock. The heads are
/// asked of all its states at once.
class TrialJudge {
 public:
  TrialJudge(const ScoredSplit& split, const TrialSample& trial)
      : split_(split),
        context_(split.context()),
        networks_(context_.networks),
        trial_(trial),
        h0_(split.Hidden(trial.first)) {}

  HeadJudgements Judge() {
    const States one = AfterOne(), two = AfterTwo(one);
    JudgeReal();
    JudgeEnds(one, 0, &result_.boundary_after_one);
    JudgeEnds(two, 1, &result_.boundary_after_two);
    JudgeImagined(Imagined(one, two));
    return std::move(result_);
  }

 private:
  const SegmentSample& Segment(int k) const { return context_.segment(trial_.first_segment + k); }

  torch::Tensor First(std::size_t states) const {
    return h0_.expand({static_cast<std::int64_t>(states), -1, -1, -1});
  }

  torch::Tensor Transformed(const torch::Tensor& h, const std::vector<int>& actions) {
    return networks_.transform->forward(First(actions.size()), h,
                                        ActionTensor(actions, context_.device));
  }

  /// After each segment, imagined from the picture on which it began.
  States AfterOne() {
    std::vector<torch::Tensor> starts;
    std::vector<int> actions;
    for (int k = 0; k < trial_.segments; ++k) {
      starts.push_back(split_.Hidden(Segment(k).start));
      actions.push_back(Segment(k).action);
    }
    return {Transformed(torch::cat(starts), actions).split(1), actions};
  }

  /// After each segment but the first, imagined from the picture on which the one before it began.
  States AfterTwo(const States& one) {
    const std::vector<int> actions(one.action.begin() + 1, one.action.end());
    if (actions.empty()) return {};
    const std::vector<torch::Tensor> before(one.h.begin(), one.h.end() - 1);
    return {Transformed(torch::cat(before), actions).split(1), actions};
  }

  /// After each segment, imagined from the first picture.
  States Imagined(const States& one, const States& two) {
    States chain;
    for (int k = 0; k < trial_.segments; ++k) {
      const int action = Segment(k).action;
      if (k == 0) chain.Add(one.h[0], action);
      if (k == 1) chain.Add(two.h[0], action);
      if (k > 1) chain.Add(Transformed(chain.h.back(), {action}), action);
    }
    return chain;
  }

  /// f of each.
  std::vector<float> Done(const States& states) {
    // What no action led to is asked about the first one; nobody reads the answer.
    const torch::Tensor actions =
        ActionTensor(states.action, context_.device).clamp_max(context_.samples.num_actions - 1);
    return Floats(networks_.f->forward(First(states.size()), torch::cat(states.h), actions));
  }

  static std::vector<float> Floats(const torch::Tensor& logits) {
    const torch::Tensor shares = torch::sigmoid(logits).to(torch::kCPU).contiguous();
    const float* first = shares.data_ptr<float>();
    return {first, first + shares.numel()};
  }

  std::vector<Said> Ask(const States& states) {
    const torch::Tensor h0 = First(states.size()), h = torch::cat(states.h);
    const torch::Tensor actions = ActionTensor(states.action, context_.device);
    const std::vector<float> value = Floats(networks_.value->forward(h)), done = Done(states);
    const std::vector<float> p = Floats(networks_.p->forward(h0, h, actions));
    const std::vector<float> q = Floats(networks_.q->forward(h0, h, actions));
    const auto row = [this](const std::vector<float>& all, std::size_t i) {
      const auto begin =
          all.begin() + static_cast<std::ptrdiff_t>(i) * context_.samples.num_actions;
      return std::vector<float>(begin, begin + context_.samples.num_actions);
    };
    std::vector<Said> said;
    for (std::size_t i = 0; i < states.size(); ++i)
      said.push_back({value[i], done[i], row(p, i), row(q, i)});
    return said;
  }

  void JudgeNext(const Said& said, int action, int k_next, StateJudgements* to) {
    for (int a = 0; a < context_.samples.num_actions; ++a) {
      to->p.push_back(
          {said.p[static_cast<std::size_t>(a)], MayFollow(context_.samples, trial_, action, a)});
    }
    if (k_next >= trial_.segments) return;
    const auto next = static_cast<std::size_t>(Segment(k_next).action);
    to->taken.push_back({said.p[next], true});
    to->q.push_back({said.q[next], trial_.succeeded});
  }

  void JudgeReal() {
    States seen;
    seen.Add(h0_, context_.samples.num_actions);
    for (int k = 0; k < trial_.segments; ++k)
      seen.Add(split_.Hidden(Segment(k).goal), Segment(k).action);
    const std::vector<Said> said = Ask(seen);
    StateJudgements* real = &result_.real;
    real->value.push_back({said[0].value, trial_.succeeded});
    JudgeNext(said[0], context_.samples.num_actions, 0, real);
    for (int k = 0; k < trial_.segments; ++k) {
      const Said& goal = said[static_cast<std::size_t>(k) + 1];
      JudgeEnd(goal, k, real);
      JudgeInside(Segment(k), real);
      JudgeEnd(goal, k, &result_.boundary);
    }
  }

  void JudgeInside(const SegmentSample& segment, StateJudgements* to) {
    States inside;
    for (const int mid : segment.mids) inside.Add(split_.Hidden(mid), segment.action);
    if (inside.size() == 0) return;
    for (const float done : Done(inside)) to->done.push_back({done, false});
  }

  /// What is said of the state after segment k, real or imagined.
  void JudgeEnd(const Said& said, int k, StateJudgements* to) {
    const SegmentSample& segment = Segment(k);
    to->value.push_back({said.value, trial_.succeeded});
    to->done.push_back({said.done, segment.succeeded});
    JudgeNext(said, segment.action, k + 1, to);
  }

  /// States after segment `first` and those that follow it.
  void JudgeEnds(const States& states, int first, StateJudgements* to) {
    if (states.size() == 0) return;
    int k = first;
    for (const Said& said : Ask(states)) JudgeEnd(said, k++, to);
  }

  void JudgeImagined(const States& chain) {
    const std::vector<Said> said = Ask(chain);
    float plan = 1.0F;
    result_.done_at_depth.resize(said.size());
    for (int k = 0; k < trial_.segments; ++k) {
      const auto at = static_cast<std::size_t>(k);
      JudgeEnd(said[at], k, &result_.imagined);
      if (k == 0) JudgeEnd(said[at], k, &result_.after_one);
      if (k == 1) JudgeEnd(said[at], k, &result_.after_two);
      result_.done_at_depth[at] = {{said[at].done, Segment(k).succeeded}};
      plan *= said[at].done;
    }
    result_.plan.push_back({plan * said.back().value, trial_.succeeded});
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

#include "tools/figures/judgements.h"

#include <algorithm>
#include <cmath>

namespace prospect::figures {

namespace {

// Asks the heads about one trial.
class TrialJudge {
 public:
  TrialJudge(const SeenTrial& trial, model::Engine* engine, const DoneHead& done_head,
             HeadRecord* record)
      : trial_(trial), engine_(engine), done_head_(done_head), record_(record) {
    for (const sim::Image& picture : trial.seen) states_.push_back(engine->Encode(picture.rgb));
  }

  void JudgeSeen() {
    const int none = trial_.samples.num_actions;
    Add(engine_->Evaluate(h0(), h0(), none), none, 0, 0);
    for (std::size_t k = 0; k < segments().size(); ++k) {
      const model::SegmentSample& segment = segments()[k];
      const model::Hidden& goal = State(segment.goal);
      Add(engine_->Evaluate(h0(), goal, segment.action), segment.action, k + 1, 0);
      record_->f[0].push_back({done_head_(h0(), goal, segment.action), segment.succeeded});
    }
  }

  // All segments at once, so that an engine's threads have work.
  void JudgeImagined() {
    std::vector<model::Hidden> from;
    for (const model::SegmentSample& segment : segments()) from.push_back(State(segment.start));
    for (std::size_t step = 0; step < 2 && step < segments().size(); ++step) {
      std::vector<model::ExpandInput> rows;
      for (std::size_t k = 0; k + step < segments().size(); ++k) {
        rows.push_back({h0(), from[k], segments()[k + step].action});
      }
      const std::vector<model::Prediction> answers = engine_->Expand(rows);
      for (std::size_t k = 0; k < answers.size(); ++k) {
        const model::SegmentSample& done = segments()[k + step];
        Add(answers[k], done.action, k + step + 1, step + 1);
        record_->f[step + 1].push_back({answers[k].done, done.succeeded});
        from[k] = answers[k].h;
      }
    }
  }

 private:
  const std::vector<model::SegmentSample>& segments() const { return trial_.segments(); }
  const model::Hidden& State(int slot) const { return states_[static_cast<std::size_t>(slot)]; }
  const model::Hidden& h0() const { return State(trial_.trial().first); }

  // V, Q and p of a state after `action`; segment `next` follows it, if there is one.
  void Add(const model::Prediction& said, int action, std::size_t next, std::size_t transforms) {
    const bool success = trial_.trial().succeeded;
    record_->v[transforms].push_back({said.value, success});
    for (int a = 0; a < trial_.samples.num_actions; ++a) {
      record_->p[transforms].push_back(
          {said.p[static_cast<std::size_t>(a)],
           model::MayFollow(trial_.samples, trial_.trial(), action, a)});
    }
    if (next >= segments().size()) return;
    const auto taken = static_cast<std::size_t>(segments()[next].action);
    record_->q[transforms].push_back({said.q[taken], success});
  }

  const SeenTrial& trial_;
  model::Engine* engine_;
  const DoneHead& done_head_;
  HeadRecord* record_;
  std::vector<model::Hidden> states_;  // by slot
};

}  // namespace

void AddJudgements(const SeenTrial& trial, model::Engine* engine, const DoneHead& done_head,
                   HeadRecord* record) {
  TrialJudge judge(trial, engine, done_head, record);
  judge.JudgeSeen();
  judge.JudgeImagined();
}

std::array<Bin, 10> Reliability(const model::Judgements& judgements) {
  std::array<Bin, 10> bins;
  for (const model::Judgement& j : judgements) {
    const int place = std::clamp(static_cast<int>(j.score * 10.0F), 0, 9);
    Bin& bin = bins[static_cast<std::size_t>(place)];
    ++bin.count;
    bin.trues += j.truth;
    bin.mean += j.score;
  }
  for (Bin& bin : bins) bin.mean /= std::max(1, bin.count);
  return bins;
}

double CalibrationError(const std::array<Bin, 10>& bins) {
  double sum = 0;
  int count = 0;
  for (const Bin& bin : bins) {
    sum += std::abs(bin.mean * bin.count - bin.trues);
    count += bin.count;
  }
  return count == 0 ? 0 : sum / count;
}

}  // namespace prospect::figures

#include "tools/bench/engine_agreement.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "base/random.h"
#include "planner/path.h"
#include "sim/task_factory.h"
#include "tools/evaluate/decider.h"
#include "tools/evaluate/engine_model.h"
#include "tools/evaluate/first_picture.h"
#include "tools/evaluate/local_mind.h"

namespace prospect::tools {
namespace {

constexpr int kRun = 10;       // actions imagined in a row
constexpr int kRollouts = 30;  // of a search

template <typename Number>
double Apart(const std::vector<Number>& a, const std::vector<Number>& b) {
  double most = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  return most;
}

class Comparison {
 public:
  Comparison(model::Engine& engine, model::Engine& reference, const std::string& task)
      : judges_(engine.info().judges),
        task_(sim::MakeTask(task, {})),
        models_{EngineModel(&engine), EngineModel(&reference)} {}

  void Add(std::uint64_t seed) {
    const std::vector<std::uint8_t> picture =
        FirstPicture(*task_, seed, sim::TaskOptions{}.image_noise);
    for (EngineModel& model : models_) {
      model.SetFirst(picture);
      model.SetRoot(picture, task_->spec().null_action());
    }
    CompareStates(seed);
    if (judges_) CompareDecisions();
  }

  const EngineAgreement& agreement() const { return agreement_; }

 private:
  void CompareStates(std::uint64_t seed) {
    planner::Path path;
    for (const int action : RandomRun(seed)) {
      path.push_back(static_cast<std::uint8_t>(action));
      const model::Prediction& a = models_[0].Predict(path);
      const model::Prediction& b = models_[1].Predict(path);
      agreement_.state = std::max(agreement_.state, Apart(a.h, b.h));
      for (const double apart :
           {Apart(a.q, b.q), Apart(a.p, b.p), Apart<float>({a.value, a.done}, {b.value, b.done})})
        agreement_.judged = std::max(agreement_.judged, apart);
      ++agreement_.states;
    }
    const double apart =
        Apart(models_[0].Imagine({path}).front(), models_[1].Imagine({path}).front());
    agreement_.picture = std::max(agreement_.picture, apart / 255);
  }

  std::vector<int> RandomRun(std::uint64_t seed) const {
    base::Random random(seed);
    std::vector<int> run;
    int last = task_->spec().null_action();
    while (run.size() < kRun) {
      const std::vector<int>* next = &task_->spec().successors[static_cast<std::size_t>(last)];
      if (next->empty()) next = &task_->spec().successors.back();
      last = (*next)[static_cast<std::size_t>(random.Below(static_cast<int>(next->size())))];
      run.push_back(last);
    }
    return run;
  }

  void CompareDecisions() {
    const planner::Path ours = Decision(0), theirs = Decision(1);
    ++agreement_.decisions;
    if (ours == theirs) return;
    ++agreement_.differing;
    agreement_.tie = std::max(agreement_.tie, std::abs(Score(ours) - Score(theirs)));
  }

  planner::Path Decision(int which) {
    agent::SearchQuestion question;
    question.rules = RulesOf(task_->spec());
    question.parameters.samples = kRollouts;
    question.parameters.depth = question.rules.plan_length;
    return SearchWith(question, &models_[which]).plan.best.path;
  }

  /// V at the end times f along the way, by the reference.
  double Score(const planner::Path& plan) {
    double score = 1;
    planner::Path path;
    for (const std::uint8_t action : plan) {
      path.push_back(action);
      score *= models_[1].Evaluate(path).done;
    }
    return plan.empty() ? 0 : score * models_[1].Evaluate(plan).value;
  }

  bool judges_;
  std::unique_ptr<sim::Task> task_;
  EngineModel models_[2];
  EngineAgreement agreement_;
};

}  // namespace

EngineAgreement Compare(model::Engine& engine, model::Engine& reference, const std::string& task,
                        std::uint64_t first_seed, int scenes) {
  Comparison comparison(engine, reference, task);
  for (int i = 0; i < scenes; ++i) comparison.Add(first_seed + static_cast<std::uint64_t>(i));
  return comparison.agreement();
}

}  // namespace prospect::tools

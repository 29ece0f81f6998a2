#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/random.h"
#include "cli/report_file.h"
#include "sim/plan_rules.h"
#include "sim/random_plan.h"
#include "sim/rollout.h"
#include "sim/suturing/gestures.h"
#include "sim/suturing/suturing_task.h"
#include "sim/task_factory.h"
#include "tools/common/progress.h"
#include "tools/common/world.h"
#include "tools/world/commands.h"

namespace prospect::tools {
namespace {

// Means over actions, by how many of them lie between the state and the picture.
struct Floor {
  double sum = 0;
  int samples = 0;
  void Add(double error) {
    sum += error;
    ++samples;
  }
  double mean() const { return samples > 0 ? sum / samples : 0; }
};

double Difference(const sim::Image& a, const sim::Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
  return sum / 255 / static_cast<double>(a.rgb.size());
}

class Takes {
 public:
  explicit Takes(const cli::TakesOptions& options)
      : options_(options),
        task_(sim::MakeTask(options.task, WorldOf(options.scene))),
        suturing_(dynamic_cast<sim::SuturingTask*>(task_.get())) {}

  void Run() {
    Progress progress("scenes", options_.scenes);
    for (int i = 0; i < options_.scenes; ++i) {
      RunScene(options_.seed + static_cast<std::uint64_t>(i));
      progress.Step();
    }
  }
  const Floor& one() const { return one_; }
  const Floor& two() const { return two_; }

 private:
  // What the camera sees after each of `actions` from `state`; shorter where one of them failed.
  std::vector<sim::Image> Take(const sim::TaskState& state, const std::vector<int>& actions,
                               std::uint64_t noise) {
    task_->Restore(state);
    task_->SetNoiseSeed(noise);
    std::vector<sim::Image> pictures;
    for (const int action : actions) {
      if (!sim::RunAction(*task_, action, nullptr)) break;
      if (task_->progress().action_state != sim::ActionState::kSucceeded) break;
      pictures.push_back(task_->Observe());
    }
    return pictures;
  }

  // As trials are made: a surgeon's order of gestures, else uniform among what is legal.
  int Choose(const std::vector<int>& legal, int last, sim::RandomPlan* plan, base::Random* random) {
    if (suturing_ == nullptr) return plan->Choose(legal);
    const int before = last < 0 ? sim::kGestures : last;
    return sim::ChooseGesture(before, legal, suturing_->AllThrown(), random);
  }

  // The scene's own trial, a random one; from the beginning of each of its actions two more takes.
  void RunScene(std::uint64_t seed) {
    task_->Reset(seed);
    sim::RandomPlan plan(sim::PlanRules(task_->spec()), seed, /*retries=*/false);
    base::Random random(seed);
    std::unique_ptr<sim::TaskState> before;  // the state before `last`
    int last = -1;
    for (int k = 0; k < options_.most_actions; ++k) {
      const std::vector<int> legal = task_->LegalActions();
      if (legal.empty()) return;
      std::unique_ptr<sim::TaskState> state = task_->Save();
      const int action = Choose(legal, last, &plan, &random);
      if (before) Compare(*before, {last, action}, base::MixSeeds({seed, 2U * k}));
      task_->Restore(*state);
      if (!sim::RunAction(*task_, action, nullptr)) return;
      if (task_->progress().action_state != sim::ActionState::kSucceeded) return;
      before = std::move(state);
      last = action;
    }
  }

  void Compare(const sim::TaskState& state, const std::vector<int>& actions, std::uint64_t noise) {
    const auto first = Take(state, actions, noise), second = Take(state, actions, noise + 1);
    if (!first.empty() && !second.empty()) one_.Add(Difference(first[0], second[0]));
    if (first.size() > 1 && second.size() > 1) two_.Add(Difference(first[1], second[1]));
  }

  const cli::TakesOptions& options_;
  std::unique_ptr<sim::Task> task_;
  sim::SuturingTask* suturing_;  // task_, if it is one
  Floor one_, two_;
};

void Print(const Takes& takes) {
  std::printf("two takes of one action:   MAE %.4f (%d pairs)\n", takes.one().mean(),
              takes.one().samples);
  std::printf("two takes of two actions:  MAE %.4f (%d pairs)\n", takes.two().mean(),
              takes.two().samples);
}

}  // namespace

int RunTakes(const cli::TakesOptions& options) {
  Takes takes(options);
  takes.Run();
  if (options.report.talks()) Print(takes);
  cli::WriteReport(options.report,
                   {{"task", options.task},
                    {"seed", options.seed},
                    {"scenes", options.scenes},
                    {"x1", {{"mae", takes.one().mean()}, {"pairs", takes.one().samples}}},
                    {"x2", {{"mae", takes.two().mean()}, {"pairs", takes.two().samples}}}});
  return 0;
}

}  // namespace prospect::tools

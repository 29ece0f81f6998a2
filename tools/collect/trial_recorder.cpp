#include "tools/collect/trial_recorder.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "base/hash.h"
#include "base/random.h"
#include "sim/plan_rules.h"
#include "sim/random_plan.h"

namespace prospect::tools {
namespace {

float RewardOf(sim::Outcome outcome) {
  switch (outcome) {
    case sim::Outcome::kSuccess:
      return 1.0f;
    case sim::Outcome::kFailure:
      return -1.0f;
    case sim::Outcome::kRunning:
      return 0.0f;
  }
  return 0.0f;
}

constexpr std::uint64_t kForesightStream = 0x666f726573696768ULL;

// What may come next and goes on with the plan: all but beginning anew.
std::vector<int> Onward(const sim::Task& task) {
  std::vector<int> onward = task.LegalActions();
  const int last = task.progress().action;
  std::erase_if(onward, [&](int next) { return task.spec().IsRetry(last, next); });
  return onward;
}

// Looks ahead where a trial has a choice.
class Foresight {
 public:
  Foresight(sim::Task& task, std::uint64_t seed)
      : task_(task),
        builds_tower_(!sim::PlanRules(task.spec()).tower.empty()),
        random_(base::MixSeeds({seed, kForesightStream})) {}

  bool Looks(double share) { return share > 0 && random_.Uniform() < share; }

  // The next action: as `plan` draws it, or the first so drawn that goes well when tried, if any
  // does.
  int Choose(sim::RandomPlan* plan) {
    std::vector<int> left = task_.LegalActions();
    while (Onward(task_).size() > 1 && !left.empty()) {
      sim::RandomPlan drawn = *plan;
      const int action = drawn.Choose(left);
      if (GoesWell(action, drawn)) {
        *plan = drawn;
        return action;
      }
      std::erase(left, action);
    }
    return plan->Choose(task_.LegalActions());
  }

 private:
  // Whether an action, and what has to follow it up to the next choice, goes well from here, tried
  // with other noise. The task is left as it was.
  bool GoesWell(int action, sim::RandomPlan plan) {
    const std::unique_ptr<sim::TaskState> here = task_.Save();
    const std::size_t facts = task_.Facts().size();
    task_.SetNoiseSeed(random_.Next());
    sim::RunAction(task_, action, nullptr);
    while (Onward(task_).size() == 1) {
      sim::RunAction(task_, plan.Choose(task_.LegalActions()), nullptr);
    }
    const bool well = task_.progress().outcome != sim::Outcome::kFailure &&
                      task_.Facts().size() >= facts + (builds_tower_ && RoundIsOver() ? 1 : 0);
    task_.Restore(*here);
    return well;
  }

  // Whether what comes next is what a plan begins with: of a tower, another level.
  bool RoundIsOver() const {
    const std::vector<int>& first = task_.spec().successors.back();
    const std::vector<int> next = Onward(task_);
    return std::all_of(next.begin(), next.end(), [&](int action) {
      return std::binary_search(first.begin(), first.end(), action);
    });
  }

  sim::Task& task_;
  bool builds_tower_;
  base::Random random_;
};

}  // namespace

TrialRecorder::TrialRecorder(const sim::Task& task, std::uint64_t seed) : task_(task) {
  const sim::TaskSpec& spec = task.spec();
  trial_.seed = seed;
  trial_.task = spec.name;
  trial_.width = spec.image_width;
  trial_.height = spec.image_height;
  trial_.tick_seconds = spec.tick_seconds;
  trial_.num_actions = spec.null_action();
  trial_.plan_length = spec.plan_length;
  trial_.world_version = spec.world_version;
  trial_.task_hash = base::HexText(spec.Hash());
  trial_.num_landmarks = static_cast<int>(spec.landmarks.size());
}

void TrialRecorder::OnFrame(const sim::Image& image, const sim::Progress& progress) {
  trial_.images.insert(trial_.images.end(), image.rgb.begin(), image.rgb.end());
  for (const sim::Landmark& landmark : task_.Landmarks()) {
    trial_.landmarks.push_back(static_cast<float>(landmark.u));
    trial_.landmarks.push_back(static_cast<float>(landmark.v));
  }
  trial_.actions.push_back(progress.action);
  trial_.prev_action.push_back(progress.previous_action);
  trial_.segment.push_back(progress.segment);
  trial_.rewards.push_back(RewardOf(progress.outcome));
  trial_.dones.push_back(progress.outcome == sim::Outcome::kRunning ? 0 : 1);
  trial_.segment_succeeded.resize(progress.segment + 1, 0);
  if (progress.action_state == sim::ActionState::kSucceeded) trial_.segment_succeeded.back() = 1;
}

model::Trial TrialRecorder::Finish(double image_noise) const {
  model::Trial trial = trial_;
  const sim::Progress progress = task_.progress();
  trial.outcome = sim::ToString(progress.outcome);
  trial.reason = progress.reason;
  trial.image_noise = image_noise;
  trial.light = task_.light();
  trial.successors = task_.spec().successors;
  for (bool present : task_.PresentActions()) trial.present.push_back(present ? 1 : 0);
  return trial;
}

model::Trial RecordRandomTrial(sim::Task& task, std::uint64_t seed, double image_noise,
                               double foresight) {
  task.Reset(seed);
  TrialRecorder recorder(task, seed);
  recorder.OnFrame(task.Observe(), task.progress());
  sim::RandomPlan plan(sim::PlanRules(task.spec()), seed);
  Foresight ahead(task, seed);
  for (std::vector<int> legal = task.LegalActions(); !legal.empty(); legal = task.LegalActions()) {
    const int action = ahead.Looks(foresight) ? ahead.Choose(&plan) : plan.Choose(legal);
    sim::RunAction(task, action, &recorder);
  }
  return recorder.Finish(image_noise);
}

}  // namespace prospect::tools

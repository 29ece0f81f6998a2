#include "tools/ceiling/replay.h"

#include <memory>
#include <vector>

#include "base/random.h"
#include "sim/plan_rules.h"
#include "sim/random_plan.h"
#include "sim/rollout.h"

namespace prospect::tools {
namespace {

constexpr std::uint64_t kNoiseStream = 0x6365696cULL;
constexpr std::uint64_t kPlanStream = 0x6f6e77617264ULL;
constexpr std::size_t kNext = 2;

// A trial's actions before a moment, and the first ones after it.
struct Story {
  std::vector<int> before, next;  // `next`: at most kNext
};

// The task is left at the moment. Empty if the trial has fewer actions.
std::optional<Story> TellStory(sim::Task& task, std::uint64_t seed, int number) {
  task.Reset(seed);
  sim::RandomPlan plan(sim::PlanRules(task.spec()), seed);
  Story story;
  std::unique_ptr<sim::TaskState> moment;
  while (story.next.size() < kNext) {
    const std::vector<int> legal = task.LegalActions();
    const bool before = static_cast<int>(story.before.size()) < number;
    if (!before && moment == nullptr) moment = task.Save();
    if (legal.empty()) break;
    const int action = plan.Choose(legal);
    (before ? story.before : story.next).push_back(action);
    sim::RunAction(task, action, nullptr);
  }
  if (moment == nullptr) return std::nullopt;
  task.Restore(*moment);
  return story;
}

class Repeater {
 public:
  Repeater(sim::Task& task, const Story& story, std::uint64_t seed, int runs)
      : task_(task), story_(story), seed_(seed), runs_(runs), moment_(task.Save()) {}

  // Each time carries out the first `chosen` of the story's next actions, then random ones.
  void Repeat(std::size_t chosen, Repetitions* value, Repetitions* done, PictureErrors* pictures) {
    if (chosen > story_.next.size()) return;
    std::vector<sim::Image> first, second;
    for (int run = 0; run < runs_; ++run) {
      task_.Restore(*moment_);
      task_.SetNoiseSeed(Stream(kNoiseStream, chosen, run));
      if (!CarryOut(chosen)) continue;
      const bool succeeded = task_.progress().action_state == sim::ActionState::kSucceeded;
      if (done != nullptr) Count(run, succeeded, done);
      if (pictures != nullptr) (run < runs_ / 2 ? first : second).push_back(task_.Observe());
      Finish(chosen, run);
      Count(run, task_.progress().outcome == sim::Outcome::kSuccess, value);
    }
    if (pictures != nullptr) *pictures = ErrorsOf(first, second);
  }

 private:
  std::uint64_t Stream(std::uint64_t stream, std::size_t chosen, int run) const {
    return base::MixSeeds({seed_, stream, chosen, static_cast<std::uint64_t>(run)});
  }

  void Count(int run, bool came_true, Repetitions* to) const {
    Frequency& half = run < runs_ / 2 ? to->first : to->second;
    ++half.runs;
    half.came_true += came_true;
  }

  // Whether all of them were begun.
  bool CarryOut(std::size_t chosen) {
    for (std::size_t i = 0; i < chosen; ++i) {
      if (!sim::RunAction(task_, story_.next[i], nullptr)) return false;
    }
    return true;
  }

  void Finish(std::size_t chosen, int run) {
    sim::RandomPlan plan(sim::PlanRules(task_.spec()), Stream(kPlanStream, chosen, run));
    for (const int action : story_.before) plan.Follow(action);
    for (std::size_t i = 0; i < chosen; ++i) plan.Follow(story_.next[i]);
    for (auto legal = task_.LegalActions(); !legal.empty(); legal = task_.LegalActions()) {
      sim::RunAction(task_, plan.Choose(legal), nullptr);
    }
  }

  sim::Task& task_;
  const Story& story_;
  const std::uint64_t seed_;
  const int runs_;
  const std::unique_ptr<sim::TaskState> moment_;
};

}  // namespace

std::optional<Moment> Replay(sim::Task& task, std::uint64_t seed, int number, int runs) {
  const std::optional<Story> story = TellStory(task, seed, number);
  if (!story) return std::nullopt;
  Repeater repeater(task, *story, seed, runs);
  Moment moment;
  repeater.Repeat(0, &moment.value, nullptr, nullptr);
  repeater.Repeat(1, &moment.value_one, &moment.done_one, &moment.pictures_one);
  repeater.Repeat(2, &moment.value_two, &moment.done_two, &moment.pictures_two);
  return moment;
}

}  // namespace prospect::tools

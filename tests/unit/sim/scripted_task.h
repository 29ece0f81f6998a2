#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/task.h"

namespace prospect::sim {

// A task without a world: an action takes two ticks and succeeds as a function of the actions so
// far and the noise seed says. Four actions, plans of three, no repeats; an action not in `present`
// is never legal.
class ScriptedTask : public Task {
 public:
  using Rule = std::function<std::string(const std::vector<int>& path, std::uint64_t noise)>;

  // `rule` gives the reason for failing, empty for success.
  explicit ScriptedTask(Rule rule, std::vector<bool> present = {true, true, true, true})
      : rule_(std::move(rule)), present_(std::move(present)) {
    spec_.name = "scripted";
    spec_.plan_length = 3;
    spec_.image_width = spec_.image_height = 1;
    for (int i = 0; i < 4; ++i) {
      spec_.actions.push_back({i, "touch(" + std::to_string(i) + ")", "touch", std::to_string(i)});
    }
    spec_.successors.resize(5);
    for (int from = 0; from < 5; ++from) {
      for (int to = 0; to < 4; ++to) {
        if (to != from) spec_.successors[from].push_back(to);
      }
    }
    Reset(0);
  }

  const TaskSpec& spec() const override { return spec_; }
  void Reset(std::uint64_t seed) override {
    state_ = State();
    state_.noise = seed;
    state_.progress.action = state_.progress.previous_action = spec_.null_action();
  }
  bool StartAction(int action) override {
    const std::vector<int> legal = LegalActions();
    if (state_.left > 0 || std::find(legal.begin(), legal.end(), action) == legal.end()) {
      return false;
    }
    Progress& p = state_.progress;
    p.previous_action = p.action;
    p.action = action;
    p.action_state = ActionState::kRunning;
    ++p.segment;
    state_.path.push_back(action);
    state_.left = 2;
    ++starts;
    return true;
  }
  void Cancel() override { state_.left = 0; }
  void Tick() override {
    state_.progress.time += spec_.tick_seconds;
    if (state_.left > 0 && --state_.left == 0) End();
  }
  Image Observe() override { return {1, 1, {1, 2, 3}}; }
  Image Render(int, int) override { return Observe(); }
  Progress progress() const override { return state_.progress; }
  std::vector<double> RobotState() const override { return {}; }
  std::unique_ptr<TaskState> Save() const override { return std::make_unique<State>(state_); }
  void Restore(const TaskState& state) override { state_ = dynamic_cast<const State&>(state); }
  void SetNoiseSeed(std::uint64_t noise) override { state_.noise = noise; }
  std::vector<int> LegalActions() const override {
    std::vector<int> legal;
    if (state_.progress.outcome != Outcome::kRunning) return legal;
    for (int i = 0; i < 4; ++i) {
      const bool used = std::find(state_.path.begin(), state_.path.end(), i) != state_.path.end();
      if (present_[i] && !used) legal.push_back(i);
    }
    return legal;
  }
  std::vector<bool> PresentActions() const override { return present_; }
  double light() const override { return 1; }

  int starts = 0;  // actions begun since construction

 private:
  struct State : TaskState {
    Progress progress;
    std::vector<int> path;
    std::uint64_t noise = 0;
    int left = 0;
  };

  void End() {
    Progress& p = state_.progress;
    p.reason = rule_(state_.path, state_.noise);
    p.action_state = p.reason.empty() ? ActionState::kSucceeded : ActionState::kFailed;
    if (!p.reason.empty()) p.outcome = Outcome::kFailure;
    if (p.reason.empty() && ++p.actions_done == spec_.plan_length) p.outcome = Outcome::kSuccess;
  }

  TaskSpec spec_;
  Rule rule_;
  std::vector<bool> present_;
  State state_;
};

}  // namespace prospect::sim

#include "agent/illustration.h"

#include <utility>

#include "agent/why_lost.h"

namespace prospect::agent {
namespace {

using planner::Future;
using planner::Path;

// An action that p rules out was never imagined, so there is nothing to show.
bool Imagined(const Future& future) {
  return future.path.size() > 1 || future.rejection != planner::Rejection::kNotPermitted;
}

FutureRecord RecordOf(const Future& future, const TaskView& task, double chosen_score) {
  FutureRecord record;
  for (const auto action : future.path) record.names.push_back(task.ActionName(action));
  record.score = future.score;
  record.value = future.steps.back().value;
  record.done = future.steps.back().done;
  record.visits = future.visits;
  record.rejected = future.rejection != planner::Rejection::kNone;
  record.why = WhyNot(future, chosen_score);
  return record;
}

}  // namespace

std::vector<Future> OtherFirstActions(const planner::Plan& plan) {
  std::vector<Future> others;
  std::set<int> seen;
  if (plan.ok()) seen.insert(plan.best.path.front());
  for (const auto* list : {&plan.runners_up, &plan.rejected}) {
    for (const auto& future : *list) {
      if (!future.path.empty() && seen.insert(future.path.front()).second) others.push_back(future);
    }
  }
  return others;
}

std::set<Path> StatesOf(const planner::Plan& plan) {
  const Path& path = plan.best.path;
  std::set<Path> states;
  for (std::size_t n = 1; n <= path.size(); ++n)
    states.emplace(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(n));
  for (const auto& future : OtherFirstActions(plan)) {
    if (Imagined(future)) states.insert({future.path.front()});
  }
  return states;
}

std::vector<StepRecord> StepsOf(const planner::Plan& plan, const TaskView& task) {
  std::vector<StepRecord> steps;
  for (const auto& step : plan.best.steps) {
    StepRecord record;
    record.action = step.action;
    record.name = task.ActionName(step.action);
    record.score = step.score;
    record.value = step.value;
    record.done = step.done;
    record.visits = step.visits;
    record.predicted = step.done >= 0.5f;
    steps.push_back(record);
  }
  return steps;
}

void Illustrate(const planner::Plan& plan, const TaskView& task, std::map<Path, Picture> pictures,
                SearchRecord* record) {
  SetPictures(pictures, &record->steps);
  for (const auto& future : OtherFirstActions(plan)) {
    record->others.push_back(RecordOf(future, task, plan.best.score));
    record->others.back().imagined = std::move(pictures[{future.path.front()}]);
  }
}

std::vector<Path> StatesOf(const std::vector<StepRecord>& steps) {
  std::vector<Path> states;
  Path path;
  for (const auto& step : steps) {
    path.push_back(static_cast<std::uint8_t>(step.action));
    states.push_back(path);
  }
  return states;
}

void SetPictures(std::map<Path, Picture> pictures, std::vector<StepRecord>* steps) {
  const std::vector<Path> states = StatesOf(*steps);
  for (std::size_t i = 0; i < states.size(); ++i)
    (*steps)[i].imagined = std::move(pictures[states[i]]);
}

}  // namespace prospect::agent

#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "agent/mind.h"
#include "agent/world.h"

namespace prospect::agent {

/// What ends an episode from outside.
class Lost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The calls of an episode's ports, in order, and the one at which somebody falls silent.
struct Script {
  std::vector<std::string> calls;
  std::string silent_at;  ///< name of a call; empty: everybody answers
  int after = 0;          ///< so many calls of that name are answered before

  void Call(const std::string& name) {
    calls.push_back(name);
    if (name == silent_at && after-- == 0) throw Lost(name + " fell silent");
  }
  std::string Text() const {
    std::string text;
    for (const auto& call : calls) text += (text.empty() ? "" : " ") + call;
    return text;
  }
};

inline Picture Shade(std::uint8_t value) {
  return {8, 8, std::vector<std::uint8_t>(8 * 8 * 3, value)};
}

/// Four things, three of which are to be visited in any order.
inline TaskView VisitTask() {
  TaskView task;
  task.name = "visits";
  task.world_version = "scripted";
  for (const char* thing : {"barrel", "pylon", "rock", "tree"}) {
    task.actions.push_back("visit(" + std::string(thing) + ")");
    task.words.push_back({"investigate", thing});
    task.goals.push_back({"visited", {thing}, {{-1, static_cast<int>(task.goals.size())}}, {}});
  }
  task.rules = planner::AnyOrder(4, 3);
  task.causes = {{"time", "it ran out of time"}};
  return task;
}

/// A world that does as its script says: an action takes a second; those without a result of their
/// own succeed, and so does the trial when the plan is complete.
class ScriptedWorld : public World {
 public:
  explicit ScriptedWorld(Script& script) : script_(script) {}

  void Await() override { script_.Call("await"); }
  const TaskView& task() const override { return view; }
  Glimpse Begin() override {
    script_.Call("begin");
    return Now();
  }
  std::int64_t seed() const override { return scene ? scene->seed : -1; }
  std::optional<SceneLabel> label() const override { return scene; }
  ActionResult CarryOut(int action) override {
    script_.Call("carry_out(" + std::to_string(action) + ")");
    ActionResult result;
    const auto begun = carried_out.size();
    if (begun + 1 == static_cast<std::size_t>(length)) result.outcome = TrialOutcome::kSuccess;
    if (begun < results.size()) result = results[begun];
    if (result.state != ActionState::kRefused) carried_out.push_back(action);
    return result;
  }
  Glimpse Look() override {
    script_.Call("look");
    return Now();
  }
  std::vector<Picture> Frames() const override { return {Shade(0)}; }

  TaskView view = VisitTask();
  std::optional<SceneLabel> scene = SceneLabel{7, {true, true, true, true}};
  int length = 3;                              ///< actions after which the trial succeeds
  std::vector<ActionResult> results;           ///< of the first actions, in turn
  std::map<std::size_t, std::uint8_t> shades;  ///< of pictures, by actions carried out; else 0
  std::vector<int> carried_out;

 private:
  Glimpse Now() const {
    const auto shade = shades.find(carried_out.size());
    return {Shade(shade == shades.end() ? 0 : shade->second),
            static_cast<std::int64_t>(carried_out.size()), 1.0 * carried_out.size()};
  }

  Script& script_;
};

/// A plan that may be carried out.
inline planner::Plan PlanOf(const planner::Path& path, double score = 0.9) {
  planner::Plan plan;
  plan.status = planner::PlanStatus::kPlan;
  plan.best.path = path;
  plan.best.complete = true;
  plan.best.score = score;
  for (const auto action : path) {
    planner::PlanStep step;
    step.action = action;
    step.value = static_cast<float>(score);
    step.done = 1;
    step.score = score;
    plan.best.steps.push_back(step);
  }
  return plan;
}

inline planner::Plan Refusal(const std::string& reason) {
  planner::Plan plan;
  plan.status = planner::PlanStatus::kRefused;
  plan.reason = reason;
  return plan;
}

/// A mind that finds the plans of its script, one a search, and imagines black pictures.
class ScriptedMind : public Mind {
 public:
  explicit ScriptedMind(Script& script) : script_(script) {}

  MindInfo Choose() override {
    script_.Call("choose");
    return {"scripted", "00000000000000aa", 0.25};
  }
  std::vector<model::CalibrationSample> Calibrations(bool needed) override {
    script_.Call(needed ? "calibration(needed)" : "calibration");
    if (needed && calibrations.empty()) throw Lost("no calibration");
    return calibrations;
  }
  SearchAnswer Search(const SearchQuestion& question) override {
    script_.Call("search");
    questions.push_back(question);
    SearchAnswer answer;
    answer.plan = plans.empty() ? Refusal("nothing is left to find") : plans.front();
    if (!plans.empty()) plans.pop_front();
    answer.ended_by = "samples";
    answer.rollouts = 30;
    answer.evaluations = 20;
    answer.search_id = static_cast<std::int64_t>(questions.size());
    return answer;
  }
  std::map<planner::Path, planner::Evaluation> Judge(
      const std::vector<planner::Path>& paths) override {
    script_.Call("judge");
    std::map<planner::Path, planner::Evaluation> evaluations;
    for (const auto& path : paths) {
      evaluations[path].value = 0.5f;
      evaluations[path].q = evaluations[path].p = std::vector<float>(16, 0.5f);
    }
    return evaluations;
  }
  std::map<planner::Path, Picture> Imagine(const std::vector<planner::Path>& paths) override {
    script_.Call("imagine");
    std::map<planner::Path, Picture> pictures;
    for (const auto& path : paths) {
      if (draws) pictures[path] = Shade(0);
    }
    return pictures;
  }
  Recognition Familiar() override {
    script_.Call("familiar");
    return recognition;
  }

  std::deque<planner::Plan> plans;                     ///< beyond: refusals
  std::vector<model::CalibrationSample> calibrations;  ///< one for each kind of scenes
  Recognition recognition;
  bool draws = true;
  std::vector<SearchQuestion> questions;

 private:
  Script& script_;
};

}  // namespace prospect::agent

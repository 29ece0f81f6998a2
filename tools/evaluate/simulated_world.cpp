#include "tools/evaluate/simulated_world.h"

#include <cmath>
#include <utility>

#include "base/sensor_noise.h"
#include "cli/options/task.h"
#include "sim/plan_rules.h"
#include "sim/rollout.h"
#include "tasks/agreement.h"

namespace prospect::tools {
namespace {

agent::TrialOutcome OutcomeOf(const sim::Progress& progress) {
  switch (progress.outcome) {
    case sim::Outcome::kSuccess:
      return agent::TrialOutcome::kSuccess;
    case sim::Outcome::kFailure:
      return agent::TrialOutcome::kFailure;
    case sim::Outcome::kRunning:
      break;
  }
  return agent::TrialOutcome::kRunning;
}

}  // namespace

agent::TaskView TaskViewOf(const sim::TaskSpec& spec) {
  agent::TaskView view;
  view.name = spec.name;
  view.world_version = spec.world_version;
  for (const sim::ActionSpec& action : spec.actions) {
    view.actions.push_back(action.name);
    view.words.push_back({action.kind, action.object});
  }
  view.rules = sim::PlanRules(spec);
  view.goals = GoalsOf(spec);
  for (const sim::CauseSpec& cause : spec.causes) view.causes[cause.name] = cause.words;
  if (spec.tick_seconds > 0) view.frames_per_second = 1 / spec.tick_seconds;
  return view;
}

std::vector<planner::GoalFact> GoalsOf(const sim::TaskSpec& spec) {
  const tasks::TaskFile* file = cli::InstalledTask(spec.name);
  if (file == nullptr) return {};
  return tasks::ForScene(*file, spec).goals;
}

agent::SceneLabel SceneLabelOf(const sim::Task& task, std::uint64_t scene_seed) {
  return {static_cast<std::int64_t>(scene_seed), task.PresentActions()};
}

SimulatedWorld::SimulatedWorld(sim::Task& task, std::uint64_t scene_seed, double image_noise,
                               AfterAction after)
    : task_(task),
      seed_(scene_seed),
      image_noise_(image_noise),
      after_(std::move(after)),
      view_(TaskViewOf(task.spec())) {}

agent::Glimpse SimulatedWorld::Begin() {
  task_.Reset(seed_);
  return Look();
}

agent::Glimpse SimulatedWorld::Look() {
  const double time = task_.progress().time;
  sim::Image image = task_.Observe();
  const auto frame = static_cast<std::int64_t>(std::llround(time / task_.spec().tick_seconds));
  base::AddSensorNoise(image.rgb.data(), image.rgb.size(), seed_, frame, image_noise_);
  return {{image.width, image.height, std::move(image.rgb)}, frame, time};
}

agent::ActionResult SimulatedWorld::CarryOut(int action) {
  if (!sim::RunAction(task_, action, nullptr))
    return {agent::ActionState::kRefused, OutcomeOf(task_.progress()), "it is not possible now"};
  const sim::Progress progress = task_.progress();
  if (after_ && progress.outcome == sim::Outcome::kRunning) after_(task_);
  const bool succeeded = progress.action_state == sim::ActionState::kSucceeded;
  return {succeeded ? agent::ActionState::kSucceeded : agent::ActionState::kFailed,
          OutcomeOf(progress), progress.reason};
}

}  // namespace prospect::tools

#include "services/simulator/scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/sensor_noise.h"
#include "services/binding/task_messages.h"

namespace prospect::services {
namespace {

// A Husky at full speed stands still well within this simulated time after its motors are told to
// stop.
constexpr int kBrakingTicks = 10;

std::int64_t Microseconds(double seconds) { return std::llround(seconds * 1e6); }

std::vector<std::int32_t> Narrow(const std::vector<int>& values) {
  return {values.begin(), values.end()};
}

action_t MakeAction(const sim::ActionSpec& spec, const std::vector<int>& successors) {
  action_t action{};
  action.index = spec.index;
  action.name = spec.name;
  action.kind = spec.kind;
  action.object = spec.object;
  action.successors = Narrow(successors);
  action.num_successors = static_cast<std::int32_t>(action.successors.size());
  return action;
}

}  // namespace

task_t MakeTaskMessage(const sim::TaskSpec& spec) {
  task_t task{};
  task.name = spec.name;
  task.world_version = spec.world_version;
  for (std::size_t i = 0; i < spec.actions.size(); ++i) {
    task.actions.push_back(MakeAction(spec.actions[i], spec.successors.at(i)));
  }
  task.num_actions = static_cast<std::int32_t>(task.actions.size());
  task.initial = Narrow(spec.successors.at(spec.actions.size()));
  task.num_initial = static_cast<std::int32_t>(task.initial.size());
  task.plan_length = spec.plan_length;
  task.repeats_allowed = spec.repeats_allowed ? 1 : 0;
  task.image_width = spec.image_width;
  task.image_height = spec.image_height;
  task.tick_seconds = spec.tick_seconds;
  task.action_time_limit = spec.action_time_limit;
  for (const sim::CauseSpec& cause : spec.causes) task.causes.push_back({cause.name, cause.words});
  task.num_causes = static_cast<std::int32_t>(task.causes.size());
  task.task_hash = TaskHash(task);
  return task;
}

std::int8_t OutcomeCode(sim::Outcome outcome) {
  switch (outcome) {
    case sim::Outcome::kRunning:
      return label_t::OUTCOME_RUNNING;
    case sim::Outcome::kSuccess:
      return label_t::OUTCOME_SUCCESS;
    case sim::Outcome::kFailure:
      return label_t::OUTCOME_FAILURE;
  }
  return label_t::OUTCOME_UNKNOWN;
}

Scene::Scene(std::string task_name, const sim::TaskOptions& options, std::int64_t episode_id,
             std::uint64_t seed)
    : task_name_(std::move(task_name)), options_(options) {
  MakeTask();
  Reset(episode_id, seed, 0, 0);
}

void Scene::MakeTask() {
  task_ = sim::MakeTask(task_name_, options_);
  task_message_ = MakeTaskMessage(task_->spec());
}

void Scene::Reset(std::int64_t episode_id, std::uint64_t seed, int objects, int legs) {
  if (episode_id == episode_id_)
    throw std::invalid_argument("a new episode needs a name that the present one does not have");
  sim::TaskOptions wanted = options_;
  if (objects > 0) wanted.objects = objects;
  if (legs > 0) sim::SetPlanLength(task_name_, legs, &wanted);
  if (wanted.objects != options_.objects || wanted.legs != options_.legs ||
      wanted.tower != options_.tower) {
    const sim::TaskOptions before = std::exchange(options_, wanted);
    try {
      MakeTask();
    } catch (...) {
      options_ = before;
      throw;
    }
  }
  task_->Reset(seed);
  episode_id_ = episode_id;
  seed_ = seed;
  braking_ticks_ = 0;
  Capture(0, false);
}

bool Scene::running() const { return task_->progress().action_state == sim::ActionState::kRunning; }

std::string Scene::Start(int action) {
  const auto progress = task_->progress();
  if (progress.outcome != sim::Outcome::kRunning) return "the trial is over";
  if (moving()) return "another action is running";
  const auto& table = task_->spec().actions;
  if (action < 0 || action >= static_cast<int>(table.size())) {
    return "action " + std::to_string(action) + " is not in the table of " +
           std::to_string(table.size());
  }
  const auto legal = task_->LegalActions();
  if (std::find(legal.begin(), legal.end(), action) == legal.end()) {
    return table[action].name + " is not possible now";
  }
  return task_->StartAction(action) ? "" : "the task refused the action";
}

void Scene::Cancel() {
  if (!running()) return;
  task_->Cancel();
  braking_ticks_ = kBrakingTicks;
}

void Scene::Tick() {
  const bool was_running = running();
  if (!was_running && braking_ticks_ > 0) --braking_ticks_;
  task_->Tick();
  Capture(observation_.frame + 1, was_running && !running());
}

void Scene::Capture(std::int64_t frame, bool segment_end) {
  sim::Image image = task_->Observe();
  base::AddSensorNoise(image.rgb.data(), image.rgb.size(), seed_, frame, options_.image_noise);
  const auto progress = task_->progress();

  observation_ = observation_t{};
  observation_.sim_time_us = Microseconds(progress.time);
  observation_.episode_id = episode_id_;
  observation_.frame = frame;
  observation_.encoding = observation_t::ENCODING_RGB8;
  observation_.width = image.width;
  observation_.height = image.height;
  observation_.data = std::move(image.rgb);
  observation_.num_bytes = static_cast<std::int32_t>(observation_.data.size());

  label_ = label_t{};
  label_.sim_time_us = observation_.sim_time_us;
  label_.episode_id = episode_id_;
  label_.frame = frame;
  label_.seed = static_cast<std::int64_t>(seed_);
  label_.action = progress.action;
  label_.previous_action = progress.previous_action;
  label_.segment = progress.segment;
  label_.segment_end = segment_end ? 1 : 0;
  label_.outcome = OutcomeCode(progress.outcome);
  label_.reason = progress.reason;
  label_.light = task_->light();
  label_.image_noise = options_.image_noise;
  for (const bool present : task_->PresentActions()) label_.present.push_back(present ? 1 : 0);
  label_.num_present = static_cast<std::int32_t>(label_.present.size());
}

}  // namespace prospect::services

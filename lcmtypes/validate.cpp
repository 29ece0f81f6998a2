#include "lcmtypes/validate.h"

#include <algorithm>

#include "lcmtypes/value_check.h"

namespace prospect::messages {
namespace internal {

bool IsPath(const path_t& path) {
  return path.num_actions <= kMaxPathLength &&
         std::all_of(path.actions.begin(), path.actions.end(),
                     [](std::uint8_t action) { return action < kMaxActions; });
}

bool IsPicture(std::int32_t width, std::int32_t height, std::int32_t num_bytes) {
  return InRange(width, 1, kMaxImageSide) && InRange(height, 1, kMaxImageSide) &&
         num_bytes == width * height * 3;
}

}  // namespace internal

namespace {

using namespace internal;

// Whether each of `values` names a row of a table of `size` rows.
bool AreIndices(const std::vector<std::int32_t>& values, std::int32_t size) {
  return std::all_of(values.begin(), values.end(),
                     [&](std::int32_t value) { return InRange(value, 0, size - 1); });
}

void CheckTable(const task_t& message, ValueCheck& check) {
  for (std::int32_t i = 0; i < message.num_actions; ++i) {
    const action_t& action = message.actions[i];
    check.That(action.index == i, "actions: index out of order")
        .That(!action.name.empty(), "actions: empty name")
        .That(AreIndices(action.successors, message.num_actions),
              "actions: successor out of table");
  }
  for (const cause_t& cause : message.causes)
    check.That(!cause.name.empty() && !cause.words.empty(), "causes: empty name or words");
}

void CheckStep(const plan_step_t& step, ValueCheck& check) {
  check.That(InRange(step.action, 0, kMaxActions - 1), "steps: action out of range")
      .That(std::isfinite(step.score) && std::isfinite(step.value) && std::isfinite(step.done),
            "steps: number not finite")
      .That(IsCount(step.visits), "steps: negative visits")
      .That(InRange<int>(step.observed, 0, action_status_t::STATE_ENDED), "steps: unknown state");
}

}  // namespace

std::string Validate(const action_command_t& message) {
  ValueCheck check;
  check
      .That(InRange<int>(message.kind, action_command_t::KIND_START, action_command_t::KIND_CANCEL),
            "kind: unknown")
      .That(message.kind == action_command_t::KIND_CANCEL || message.action >= 0,
            "action: none to start")
      .That(InRange(message.action, -1, kMaxActions - 1), "action: out of range");
  return check.Result();
}

std::string Validate(const action_status_t& message) {
  ValueCheck check;
  check.That(InRange<int>(message.state, 0, action_status_t::STATE_ENDED), "state: unknown")
      .That(InRange<int>(message.outcome, 0, label_t::OUTCOME_FAILURE), "outcome: unknown")
      .That(InRange(message.action, -1, kMaxActions - 1), "action: out of range");
  return check.Result();
}

std::string Validate(const health_t& message) {
  ValueCheck check;
  check.That(!message.service.empty(), "service: empty")
      .That(InRange<int>(message.state, 0, health_t::STATE_FAULT), "state: unknown")
      .That(IsCount(message.queue), "queue: negative")
      .That(IsCount(message.received) && IsCount(message.refused), "received: negative")
      .That(std::isfinite(message.cpu_seconds), "cpu_seconds: not finite");
  return check.Result();
}

std::string Validate(const label_t& message) {
  ValueCheck check;
  check.That(IsCount(message.episode_id) && IsCount(message.frame), "frame: negative")
      .That(message.seed >= -1, "seed: below -1")
      .That(InRange(message.action, 0, message.num_present), "action: out of table")
      .That(InRange(message.previous_action, 0, message.num_present),
            "previous_action: out of table")
      .That(message.segment >= -1, "segment: below -1")
      .That(IsBoolean(message.segment_end), "segment_end: neither 0 nor 1")
      .That(InRange<int>(message.outcome, 0, label_t::OUTCOME_FAILURE), "outcome: unknown")
      .That(std::isfinite(message.light) && message.light >= 0, "light: out of range")
      .That(IsProbability(message.image_noise), "image_noise: out of range")
      .That(message.num_present <= kMaxActions, "num_present: too many");
  return check.Result();
}

std::string Validate(const observation_t& message) {
  ValueCheck check;
  check.That(IsCount(message.episode_id) && IsCount(message.frame), "frame: negative")
      .That(message.encoding == observation_t::ENCODING_RGB8, "encoding: unknown")
      .That(IsPicture(message.width, message.height, message.num_bytes),
            "data: wrong picture size");
  return check.Result();
}

std::string Validate(const plan_t& message) {
  ValueCheck check;
  check.That(InRange<int>(message.decision, 0, plan_t::DECISION_REFUSE), "decision: unknown")
      .That(std::isfinite(message.score), "score: not finite")
      .That(IsCount(message.rollouts) && IsCount(message.evaluations), "rollouts: negative")
      .That(InRange(message.num_executed, 0, message.num_steps), "num_executed: more than steps");
  for (const plan_step_t& step : message.steps) CheckStep(step, check);
  return check.Result();
}

std::string Validate(const sim_command_t& message) {
  ValueCheck check;
  check
      .That(InRange<int>(message.kind, sim_command_t::KIND_RESET, sim_command_t::KIND_RESUME),
            "kind: unknown")
      .That(IsCount(message.seed), "seed: negative")
      .That(IsCount(message.present_episode_id), "present_episode_id: negative")
      .That(message.kind != sim_command_t::KIND_RESET || message.episode_id >= 1,
            "episode_id: below 1")
      .That(InRange(message.objects, 0, kMaxActions), "objects: out of range")
      .That(InRange(message.legs, 0, kMaxPathLength), "legs: out of range");
  return check.Result();
}

std::string Validate(const task_t& message) {
  ValueCheck check;
  check.That(!message.name.empty(), "name: empty")
      .That(InRange(message.num_actions, 1, kMaxActions), "num_actions: out of range")
      .That(AreIndices(message.initial, message.num_actions), "initial: out of table")
      .That(InRange(message.plan_length, 1, kMaxPathLength), "plan_length: out of range")
      .That(IsBoolean(message.repeats_allowed), "repeats_allowed: neither 0 nor 1")
      .That(InRange(message.image_width, 1, kMaxImageSide) &&
                InRange(message.image_height, 1, kMaxImageSide),
            "image: out of range")
      .That(std::isfinite(message.tick_seconds) && message.tick_seconds > 0,
            "tick_seconds: not positive")
      .That(std::isfinite(message.action_time_limit) && message.action_time_limit > 0,
            "action_time_limit: not positive");
  CheckTable(message, check);
  return check.Result();
}

std::string Validate(const verdict_t& message) {
  ValueCheck check;
  check.That(IsCount(message.episode_id), "episode_id: negative")
      .That(InRange(message.action, 0, kMaxActions - 1), "action: out of range")
      .That(IsBoolean(message.succeeded), "succeeded: neither 0 nor 1");
  return check.Result();
}

}  // namespace prospect::messages

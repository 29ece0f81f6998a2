#include "services/executive/plan_message.h"

namespace prospect::services {
namespace {

plan_step_t StepMessage(const agent::StepRecord& step) {
  plan_step_t message{};
  message.action = step.action;
  message.name = step.name;
  message.score = step.score;
  message.value = step.value;
  message.done = step.done;
  message.visits = step.visits;
  message.predicted = step.predicted ? 1 : 0;
  return message;
}

}  // namespace

plan_t PlanMessage(const agent::EpisodeRecord& record) {
  const agent::SearchRecord& search = record.searches.back();
  plan_t plan{};
  plan.search_id = search.search_id;
  plan.epoch = search.epoch;
  plan.decision = search.act ? plan_t::DECISION_ACT : plan_t::DECISION_REFUSE;
  plan.reason = search.reason;
  plan.score = search.score;
  plan.rollouts = search.rollouts;
  plan.evaluations = search.evaluations;
  // The search looked from the state after the actions before it: what was carried out since is
  // told as observed.
  const std::size_t before = record.searches.size() - 1;
  plan.num_executed = static_cast<std::int32_t>(record.acts.size() - before);
  for (std::size_t i = 0; i < search.steps.size(); ++i) {
    plan.steps.push_back(StepMessage(search.steps[i]));
    if (before + i >= record.acts.size()) continue;
    const bool succeeded = record.acts[before + i].observed == "succeeded";
    plan.steps.back().observed =
        succeeded ? action_status_t::STATE_SUCCEEDED : action_status_t::STATE_FAILED;
  }
  plan.num_steps = static_cast<std::int32_t>(plan.steps.size());
  return plan;
}

}  // namespace prospect::services

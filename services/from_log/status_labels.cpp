#include "services/from_log/status_labels.h"

#include <algorithm>
#include <string>
#include <utility>

#include "services/from_log/recorded_run.h"

namespace prospect::services {
namespace {

/// A command that was carried out, as far as was heard.
struct Act {
  std::pair<std::int64_t, std::int64_t> command;  // executive and number
  action_status_t status{};                       // its first after the end; else any
  bool ended = false;
};

bool Ends(const action_status_t& status) {
  return status.state == action_status_t::STATE_SUCCEEDED ||
         status.state == action_status_t::STATE_FAILED ||
         status.state == action_status_t::STATE_CANCELLED ||
         status.state == action_status_t::STATE_ENDED;
}

// Of an action that the robot cannot judge.
void TakeVerdict(const std::vector<verdict_t>& verdicts, Act* act) {
  if (act->status.state != action_status_t::STATE_ENDED) return;
  const auto said = std::find_if(verdicts.begin(), verdicts.end(), [act](const verdict_t& verdict) {
    return std::pair(verdict.executive_id, verdict.command_id) == act->command;
  });
  if (said == verdicts.end()) return;
  act->status.state =
      said->succeeded ? action_status_t::STATE_SUCCEEDED : action_status_t::STATE_FAILED;
}

std::vector<Act> ActsOf(const std::vector<action_status_t>& statuses) {
  std::vector<Act> acts;
  for (const action_status_t& status : statuses) {
    if (status.state != action_status_t::STATE_RUNNING && !Ends(status)) continue;
    const std::pair command(status.executive_id, status.command_id);
    // A CANCEL is a command of its own, and ends what runs.
    const bool cancels =
        !acts.empty() && !acts.back().ended && status.state == action_status_t::STATE_CANCELLED;
    if (acts.empty() || (acts.back().command != command && !cancels)) acts.push_back({command});
    if (acts.back().ended) continue;
    acts.back().status = status;
    acts.back().ended = Ends(status);
  }
  return acts;
}

std::string NameOf(const task_t& task, std::int32_t action) {
  if (action < 0 || action >= task.num_actions)
    throw RunError("action " + std::to_string(action) + " is not in TASK's table");
  return task.actions[static_cast<std::size_t>(action)].name;
}

void RequireKnown(const Act& act, bool last, const task_t& task) {
  const std::string name = NameOf(task, act.status.action);
  if (!act.ended)
    throw RunError(last ? "the trial did not end" : "how " + name + " ended is missing");
  if (act.status.state == action_status_t::STATE_CANCELLED) throw RunError(name + " was cancelled");
  if (act.status.state == action_status_t::STATE_ENDED)
    throw RunError("nobody said whether " + name + " worked: record with run --ask");
}

// Of the trial, after `done` actions.
std::int8_t Verdict(const action_status_t& status, int done, const task_t& task) {
  if (status.state == action_status_t::STATE_FAILED) return label_t::OUTCOME_FAILURE;
  if (status.outcome != label_t::OUTCOME_UNKNOWN) return status.outcome;
  return done < task.plan_length ? label_t::OUTCOME_RUNNING : label_t::OUTCOME_SUCCESS;
}

label_t BeforeAll(const task_t& task) {
  label_t label{};
  label.seed = -1;
  label.action = label.previous_action = task.num_actions;
  label.segment = -1;
  label.outcome = label_t::OUTCOME_RUNNING;
  label.light = 1;
  label.num_present = task.num_actions;
  label.present.assign(static_cast<std::size_t>(task.num_actions), 1);
  return label;
}

}  // namespace

std::map<std::int64_t, label_t> LabelsFrom(const std::vector<action_status_t>& statuses,
                                           const std::vector<verdict_t>& verdicts,
                                           const task_t& task, std::int64_t last_frame) {
  label_t label = BeforeAll(task);
  std::map<std::int64_t, label_t> labels = {{0, label}};
  std::vector<Act> acts = ActsOf(statuses);
  for (Act& act : acts) TakeVerdict(verdicts, &act);
  std::int64_t frame = 0;  // on which the action begins: the one that ended the action before it
  for (std::size_t i = 0; i < acts.size(); ++i) {
    RequireKnown(acts[i], i + 1 == acts.size(), task);
    const action_status_t& end = acts[i].status;
    if (end.frame <= frame || end.frame > last_frame)
      throw RunError("pictures of " + NameOf(task, end.action) + " are missing");
    label.previous_action = label.action;
    label.action = end.action;
    ++label.segment;
    for (; frame < end.frame; ++frame) labels[frame] = label;
    const std::int8_t outcome = Verdict(end, static_cast<int>(i) + 1, task);
    if (outcome == label_t::OUTCOME_RUNNING) {
      labels[frame - 1].segment_end = 1;
      continue;
    }
    label_t& last = labels[frame] = label;
    last.segment_end = 1;
    last.outcome = outcome;
    if (last.outcome == label_t::OUTCOME_FAILURE) last.reason = end.reason;
    break;
  }
  return labels;
}

}  // namespace prospect::services

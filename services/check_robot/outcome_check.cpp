// What training will need of a robot: a table that its file knows, pictures that show what happens,
// actions of which some succeed and some fail.

#include <algorithm>
#include <cmath>
#include <set>

#include "base/number_format.h"
#include "base/random.h"
#include "base/text.h"
#include "services/binding/spec_messages.h"
#include "services/check_robot/robot_check.h"
#include "services/common/clock.h"
#include "tasks/agreement.h"

namespace prospect::services {

void RobotCheck::CheckAgreement() {
  if (file_ == nullptr) return;
  const sim::TaskSpec said = SpecFromTask(*task_);
  const tasks::TaskFile file = tasks::ForScene(*file_, said);
  const auto differences = tasks::DifferencesOf(file, said);
  Note("TASK and the task file agree", differences.empty(),
       differences.empty() ? file.path : tasks::InWords(differences, file));
  const auto unknown = tasks::UnknownCauses(file, said);
  if (!unknown.empty()) Tell("causes that the file does not list", base::Joined(unknown));
}

// Of the action that CheckAction carried out.
void RobotCheck::CheckPictures() {
  const char* rule = "pictures change while an action runs";
  if (pictures_.size() < 3) return NotTried(rule, "the action was over at once");
  const std::set<std::uint64_t> different(looks_.begin(), looks_.end());
  Note(rule, different.size() > 1,
       std::to_string(different.size()) + " of " + std::to_string(pictures_.size()) + " differ");
  const double seconds =
      1e-6 * static_cast<double>(pictures_.back().utime - pictures_.front().utime);
  std::sort(delays_.begin(), delays_.end());
  Tell("pictures a second",
       base::Fixed(static_cast<double>(pictures_.size() - 1) / std::max(seconds, 1e-3), 1) +
           ", heard " + base::Fixed(1000 * delays_[delays_.size() / 2], 0) +
           " ms after they were taken (median)");
}

bool RobotCheck::CarryOut(int action) {
  if (!Send(Command(action_command_t::KIND_START, action))) return false;
  if (status_->state == action_status_t::STATE_REFUSED) return false;
  Until([&] { return !Running(); }, 4 * task_->action_time_limit + 2);
  return true;
}

// As many actions as a plan has, in some order that the table allows.
void RobotCheck::CheckOutcomes() {
  NewScene();
  base::Random random(1);
  int succeeded = 0, failed = 0, untold = 0;
  std::vector<int> next(task_->initial.begin(), task_->initial.end());
  for (int step = 0; step < task_->plan_length && !next.empty();) {
    const std::size_t at = static_cast<std::size_t>(random.Below(static_cast<int>(next.size())));
    const int action = next[at];
    if (!CarryOut(action)) {  // in the scene's way, or done already: another
      next.erase(next.begin() + static_cast<std::ptrdiff_t>(at));
      continue;
    }
    ++step;
    succeeded += status_->state == action_status_t::STATE_SUCCEEDED;
    failed += status_->state == action_status_t::STATE_FAILED;
    untold += status_->state == action_status_t::STATE_ENDED;
    next = task_->actions[static_cast<std::size_t>(action)].successors;
  }
  std::string advice;
  if (untold > 0) {
    advice =
        ", " + std::to_string(untold) + " that the robot cannot judge: run and collect with --ask";
  } else if (succeeded == 0 || failed == 0) {
    advice = ": training needs both, so record until both have happened";
  }
  Tell("actions of a plan",
       std::to_string(succeeded) + " succeeded, " + std::to_string(failed) + " failed" + advice);
}

}  // namespace prospect::services

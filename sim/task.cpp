#include "sim/task.h"

#include <algorithm>
#include <sstream>

#include "base/hash.h"

namespace prospect::sim {

bool TaskSpec::IsRetry(int action, int next) const {
  return sim::IsRetry(successors, action, next);
}

bool IsRetry(const std::vector<std::vector<int>>& successors, int action, int next) {
  const std::vector<int>& first = successors.back();
  const auto may_come_first = [&first](int one) {
    return std::find(first.begin(), first.end(), one) != first.end();
  };
  const std::vector<int>& row = successors.at(action);
  return may_come_first(next) && !std::all_of(row.begin(), row.end(), may_come_first);
}

std::uint64_t TaskSpec::Hash() const {
  std::ostringstream text;
  text << name << '\n' << image_width << 'x' << image_height << '\n' << repeats_allowed << '\n';
  for (const ActionSpec& action : actions) {
    text << action.index << ' ' << action.name << ' ' << action.kind << ' ' << action.object
         << '\n';
  }
  for (const std::vector<int>& row : successors) {
    for (int next : row) text << next << ' ';
    text << '\n';
  }
  return base::HashText(text.str());
}

const char* ToString(ActionState state) {
  switch (state) {
    case ActionState::kIdle:
      return "idle";
    case ActionState::kRunning:
      return "running";
    case ActionState::kSucceeded:
      return "succeeded";
    case ActionState::kFailed:
      return "failed";
    case ActionState::kCancelled:
      return "cancelled";
  }
  return "unknown";
}

const char* ToString(Outcome outcome) {
  switch (outcome) {
    case Outcome::kRunning:
      return "running";
    case Outcome::kSuccess:
      return "success";
    case Outcome::kFailure:
      return "failure";
  }
  return "unknown";
}

}  // namespace prospect::sim

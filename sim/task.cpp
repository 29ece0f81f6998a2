#include "sim/task.h"

#include <algorithm>
#include <sstream>

#include "sim/fnv.h"

namespace prospect::sim {

bool TaskSpec::IsRetry(int action, int next) const {
  if (retries.empty()) return false;
  const std::vector<int>& row = retries.at(action);
  return std::find(row.begin(), row.end(), next) != row.end();
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
  return Fnv1a(text.str());
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

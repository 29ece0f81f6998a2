#include "agent/world.h"

namespace prospect::agent {

const char* ToString(ActionState state) {
  switch (state) {
    case ActionState::kSucceeded:
      return "succeeded";
    case ActionState::kFailed:
      return "failed";
    case ActionState::kCancelled:
      return "cancelled";
    case ActionState::kRefused:
      return "refused";
  }
  return "unknown";
}

}  // namespace prospect::agent

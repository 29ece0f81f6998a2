#include "services/simulator/command_gate.h"

#include <algorithm>

namespace prospect::services {

bool CommandGate::Take(std::int64_t sender, std::int64_t command_id) {
  const auto known = std::find_if(latest_.begin(), latest_.end(),
                                  [&](const auto& entry) { return entry.first == sender; });
  if (known == latest_.end()) {
    latest_.emplace_front(sender, command_id);
    if (latest_.size() > capacity_) latest_.pop_back();
    return true;
  }
  latest_.splice(latest_.begin(), latest_, known);
  if (command_id <= known->second) return false;
  known->second = command_id;
  return true;
}

}  // namespace prospect::services

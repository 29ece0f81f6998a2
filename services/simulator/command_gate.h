#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <utility>

namespace prospect::services {

/// Makes commands idempotent: lets each (sender, command id) through once, however often and in
/// whatever order it arrives. A sender's ids grow, so an id at or below the highest one taken is
/// old news. Remembers the latest `capacity` senders. One thread at a time.
class CommandGate {
 public:
  explicit CommandGate(std::size_t capacity = 256) : capacity_(capacity) {}

  /// True the first time `command_id` of `sender` is seen and no later one was taken before it.
  [[nodiscard]] bool Take(std::int64_t sender, std::int64_t command_id);

 private:
  std::size_t capacity_;
  std::list<std::pair<std::int64_t, std::int64_t>>
      latest_;  // sender, highest id; most recent first
};

}  // namespace prospect::services

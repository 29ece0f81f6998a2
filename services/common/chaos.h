#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "services/common/chaos_rules.h"
#include "services/common/raw_message.h"

namespace prospect::services {

/// A bad network for tests: stands between LCM and the Bus of one process and drops, repeats,
/// delays, reorders and changes what this process hears (each process has its own bad luck, as
/// receivers of a multicast have). What befalls a message depends only on the rule's seed, the
/// channel and how many messages of that channel came before, so a seed repeats a fault; processes
/// that shall not suffer alike need different seeds.
///
/// Not thread-safe. Time is an argument: milliseconds of any steady clock.
class Chaos {
 public:
  explicit Chaos(std::vector<ChaosRule> rules) : rules_(std::move(rules)) {}

  /// Takes what LCM delivered. It comes out of Release() once, twice or never.
  void Take(RawMessage message, std::int64_t now_ms);

  /// The messages whose time has come, in the order in which they arrive now.
  std::vector<RawMessage> Release(std::int64_t now_ms);

  /// Milliseconds until Release() has something, at most `otherwise`; a negative `otherwise` means
  /// for ever.
  std::int64_t Remaining(std::int64_t now_ms, std::int64_t otherwise) const;

  /// What was done so far: "dropped", "repeated", "held back", "corrupted", "delayed".
  const std::map<std::string, std::int64_t>& counters() const { return counters_; }

 private:
  const ChaosRule* RuleFor(const std::string& channel) const;
  void Hold(RawMessage message, std::int64_t due_ms) { held_.emplace(due_ms, std::move(message)); }

  std::vector<ChaosRule> rules_;
  std::map<std::string, std::uint64_t> taken_;    // messages so far, by channel
  std::multimap<std::int64_t, RawMessage> held_;  // by due time; equal ones in order
  std::map<std::string, std::int64_t> counters_;
};

/// The chaos of this process (options --chaos, PROSPECT_CHAOS), for every Bus opened from now on
/// that is given none of its own. Empty: none, as at the start. Call it before threads start.
/// @throws std::invalid_argument as ParseChaos does
void SetChaos(const std::string& text);
const std::string& ChaosText();

}  // namespace prospect::services

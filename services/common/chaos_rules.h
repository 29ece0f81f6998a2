#pragma once

#include <cstdint>
#include <regex>
#include <string>
#include <vector>

namespace prospect::services {

/// What bad luck strikes the messages of some channels. Shares are of messages, 0 to 1, and drawn
/// one by one: a message may be held back and changed too.
struct ChaosRule {
  double drop = 0;            ///< never arrive
  double dup = 0;             ///< arrive twice, the second up to 50 ms later
  double reorder = 0;         ///< are held back by 1 to 50 ms, so that later ones overtake
  double corrupt = 0;         ///< arrive with a few bytes changed or cut short
  std::int64_t delay_ms = 0;  ///< all arrive so much later
  std::uint64_t seed = 0;     ///< of the draws; 0: drawn at random when the rule is read
  std::regex channel;         ///< channels it strikes, whole names
  std::string text;           ///< as it was written, with the seed
};

/// Reads "drop=0.3,delay=20ms,dup=0.05,reorder=0.1,corrupt=0.01,seed=1,channel=REGEX": any of these
/// keys in any order; without channel, all channels (a regular expression here holds no ',' and no
/// ';'). Several rules are separated by ';': the first whose channel fits strikes.
/// @throws std::invalid_argument that names what cannot be read and says what could
std::vector<ChaosRule> ParseChaos(const std::string& text);

/// Why `text` is no chaos, or empty when it is (or is empty itself): for option checks.
std::string ChaosDefect(const std::string& text);

}  // namespace prospect::services

#include "services/common/chaos.h"

#include <algorithm>

#include "base/random.h"

namespace prospect::services {
namespace {

constexpr std::int64_t kLongestHoldMs = 50;
constexpr int kMostFlips = 4;

std::uint64_t HashName(const std::string& name) {
  std::uint64_t hash = 0;
  for (const char c : name) hash = base::MixSeeds({hash, static_cast<unsigned char>(c)});
  return hash;
}

std::int64_t HoldMs(base::Random& random) {
  return 1 + random.Below(static_cast<int>(kLongestHoldMs));
}

// One in four is cut short, the others get bytes flipped; each changed byte really differs.
void Corrupt(std::vector<std::uint8_t>& bytes, base::Random& random) {
  if (bytes.empty()) return;
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random.Below(static_cast<int>(n)));
  };
  if (random.Below(4) == 0) return bytes.resize(below(bytes.size()));
  const int flips = 1 + random.Below(kMostFlips);
  for (int i = 0; i < flips; ++i) {
    bytes[below(bytes.size())] ^= static_cast<std::uint8_t>(1 + random.Below(255));
  }
}

std::string& ProcessChaos() {
  static std::string text;
  return text;
}

}  // namespace

const ChaosRule* Chaos::RuleFor(const std::string& channel) const {
  const auto fits = [&](const ChaosRule& rule) { return std::regex_match(channel, rule.channel); };
  const auto rule = std::find_if(rules_.begin(), rules_.end(), fits);
  return rule == rules_.end() ? nullptr : &*rule;
}

void Chaos::Take(RawMessage message, std::int64_t now_ms) {
  const ChaosRule* rule = RuleFor(message.channel);
  if (!rule) return Hold(std::move(message), now_ms);
  base::Random random(
      base::MixSeeds({rule->seed, HashName(message.channel), taken_[message.channel]++}));
  // All draws are made whatever comes of them, so that changing one share leaves the others' draws.
  const auto struck = [&](double share, const char* name) {
    if (random.Uniform() >= share) return false;
    ++counters_[name];
    return true;
  };
  if (struck(rule->drop, "dropped")) return;
  const bool twice = struck(rule->dup, "repeated");
  const bool held = struck(rule->reorder, "held back");
  const bool changed = struck(rule->corrupt, "corrupted");
  if (rule->delay_ms > 0) ++counters_["delayed"];
  const std::int64_t due_ms = now_ms + rule->delay_ms;
  if (twice) Hold(message, due_ms + HoldMs(random));
  if (changed) Corrupt(message.bytes, random);
  Hold(std::move(message), held ? due_ms + HoldMs(random) : due_ms);
}

std::vector<RawMessage> Chaos::Release(std::int64_t now_ms) {
  std::vector<RawMessage> due;
  const auto end = held_.upper_bound(now_ms);
  for (auto held = held_.begin(); held != end; ++held) due.push_back(std::move(held->second));
  held_.erase(held_.begin(), end);
  return due;
}

std::int64_t Chaos::Remaining(std::int64_t now_ms, std::int64_t otherwise) const {
  if (held_.empty()) return otherwise;
  const std::int64_t left = std::max<std::int64_t>(0, held_.begin()->first - now_ms);
  return otherwise < 0 ? left : std::min(left, otherwise);
}

void SetChaos(const std::string& text) {
  ParseChaos(text);
  ProcessChaos() = text;
}

const std::string& ChaosText() { return ProcessChaos(); }

}  // namespace prospect::services

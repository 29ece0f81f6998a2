#include "planner/tower.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <string>

namespace prospect::planner {
namespace {

constexpr char kStackKind[] = "stack";

// Which blocks are joined: the least block of each one's part, by block. Empty: the tower is lost.
using Parts = std::vector<int>;

// Joins the parts of `upper` and `lower`; lost where they are one already.
Parts Joined(const Parts& parts, int upper, int lower) {
  if (parts.empty()) return {};
  const int one = parts[static_cast<std::size_t>(upper)];
  const int other = parts[static_cast<std::size_t>(lower)];
  if (one == other) return {};
  Parts joined = parts;
  std::replace(joined.begin(), joined.end(), std::max(one, other), std::min(one, other));
  return joined;
}

// Whether at most one part has more than one block.
bool OnePart(const Parts& parts) {
  std::set<int> of_many;
  for (std::size_t block = 0; block < parts.size(); ++block) {
    if (parts[block] != static_cast<int>(block)) of_many.insert(parts[block]);
  }
  return of_many.size() <= 1;
}

// Numbers what hand-overs lead to, from blocks that lie apart.
class Builder {
 public:
  explicit Builder(int blocks) : blocks_(blocks) {
    Parts apart(static_cast<std::size_t>(blocks));
    std::iota(apart.begin(), apart.end(), 0);
    Number(apart);
  }

  // Hand-over 1 + upper * blocks + lower is that of `upper` to `lower`.
  void Fill(TowerRules* rules) {
    for (std::size_t state = 0; state < states_.size(); ++state) {
      for (int upper = 0; upper < blocks_; ++upper) {
        for (int lower = 0; lower < blocks_; ++lower)
          rules->next.push_back(Number(Joined(states_[state], upper, lower)));
      }
    }
    for (const Parts& parts : states_) rules->stands.push_back(!parts.empty() && OnePart(parts));
    rules->num_states = static_cast<int>(states_.size());
    rules->num_handovers = blocks_ * blocks_;
  }

 private:
  std::uint16_t Number(const Parts& parts) {
    const auto [found, fresh] = numbers_.emplace(parts, static_cast<std::uint16_t>(states_.size()));
    if (fresh) states_.push_back(parts);
    return found->second;
  }

  int blocks_;
  std::vector<Parts> states_;
  std::map<Parts, std::uint16_t> numbers_;
};

}  // namespace

TowerRules OneTower(const std::vector<ActionWords>& words, const TaskRules& rules) {
  const bool stacks = std::any_of(words.begin(), words.end(),
                                  [](const ActionWords& row) { return row.kind == kStackKind; });
  if (!stacks) return {};
  const std::vector<Handover> handovers = FindHandovers(words, rules);
  std::map<std::string, int> blocks;
  for (const Handover& handover : handovers) {
    blocks.emplace(words[handover.giver].object, 0);
    blocks.emplace(words[handover.taker].object, 0);
  }
  const int count = static_cast<int>(blocks.size());
  if (count < 2 || count > kMostBlocks) return {};
  int number = 0;
  for (auto& block : blocks) block.second = number++;

  TowerRules tower;
  Builder(count).Fill(&tower);
  tower.handovers.assign(words.size() * (words.size() + 1), 0);
  for (const Handover& handover : handovers) {
    const int upper = blocks.at(words[handover.giver].object);
    const int lower = blocks.at(words[handover.taker].object);
    tower.handovers[handover.giver * words.size() + handover.taker] =
        static_cast<std::uint16_t>(1 + upper * count + lower);
  }
  return tower;
}

int TowerLevels(const TaskRules& rules) {
  if (rules.tower.empty()) return 0;
  Path path;
  int levels = 1, previous = rules.num_actions;
  while (!rules.Complete({}, path)) {
    const std::vector<int> actions = rules.AllowedActions({}, path);
    if (actions.empty()) break;
    const auto edge = static_cast<std::size_t>(previous * rules.num_actions + actions.front());
    levels += rules.tower.handovers.at(edge) > 0;
    previous = actions.front();
    path.push_back(static_cast<std::uint8_t>(previous));
  }
  return levels;
}

}  // namespace prospect::planner

#include "model/segments/hold_out.h"

#include <algorithm>
#include <stdexcept>

#include "base/hash.h"

namespace prospect::model::segments {
namespace {

using Parts = std::map<std::uint64_t, Split>;

bool Means(const std::string& pattern, const std::string& name) {
  if (!pattern.empty() && pattern.back() == '*')
    return name.rfind(pattern.substr(0, pattern.size() - 1), 0) == 0;
  return name.size() >= pattern.size() &&
         name.compare(name.size() - pattern.size(), pattern.size(), pattern) == 0;
}

/// Moves the `count` trials to train on with the lowest hashes to `to`.
void MoveByHash(const NamedTrials& trials, std::size_t count, Split to, Parts* parts) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> order;
  for (const auto& [name, number] : trials) {
    if (parts->at(number) == Split::kTrain)
      order.emplace_back(base::Mix64(base::HashText(name)), number);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size() && i < count; ++i) (*parts)[order[i].second] = to;
}

void MoveMeant(const NamedTrials& trials, const std::string& pattern, Parts* parts) {
  bool found = false;
  for (const auto& [name, number] : trials) {
    if (!Means(pattern, name)) continue;
    (*parts)[number] = Split::kTest;
    found = true;
  }
  if (found) return;
  throw std::invalid_argument("'" + pattern + "' is to be held out, but no trial is called so");
}

}  // namespace

Parts AssignParts(const NamedTrials& trials, const std::vector<std::string>& held_out) {
  Parts parts;
  for (const auto& trial : trials) parts[trial.second] = Split::kTrain;
  const std::size_t tenth = trials.size() < 3 ? 0 : std::max<std::size_t>(1, trials.size() / 10);
  for (const std::string& pattern : held_out) MoveMeant(trials, pattern, &parts);
  if (held_out.empty()) MoveByHash(trials, tenth, Split::kTest, &parts);
  const auto left = static_cast<std::size_t>(std::count_if(
      parts.begin(), parts.end(), [](const auto& part) { return part.second == Split::kTrain; }));
  if (left == 0) {
    throw std::invalid_argument("none of " + std::to_string(trials.size()) +
                                " trials is left to train on: hold out fewer");
  }
  MoveByHash(trials, std::min(tenth, left - 1), Split::kValid, &parts);
  return parts;
}

}  // namespace prospect::model::segments

#include "model/jigsaws/hold_out.h"

#include <algorithm>
#include <stdexcept>

#include "base/hash.h"

namespace prospect::model::jigsaws {
namespace {

bool IsCalled(const TrialName& trial, const std::string& name) {
  return trial.text == name || trial.text.substr(trial.text.size() - 4) == name;
}

/// Moves the `count` trials of `part` with the lowest hashes to `to`.
void MoveByHash(const std::vector<TrialName>& trials, int count, Split to,
                std::map<std::uint64_t, Split>* parts) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> order;
  for (const TrialName& trial : trials) {
    if (parts->at(trial.seed()) != Split::kTrain) continue;
    order.emplace_back(base::Mix64(base::HashText(trial.text)), trial.seed());
  }
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size() && i < static_cast<std::size_t>(count); ++i) {
    (*parts)[order[i].second] = to;
  }
}

void MoveNamed(const std::vector<TrialName>& trials, const std::string& name,
               std::map<std::uint64_t, Split>* parts) {
  const auto found = std::find_if(trials.begin(), trials.end(),
                                  [&](const TrialName& trial) { return IsCalled(trial, name); });
  if (found == trials.end()) {
    throw std::invalid_argument("trial '" + name + "' is to be held out, but is not there");
  }
  (*parts)[found->seed()] = Split::kTest;
}

void MoveUser(const std::vector<TrialName>& trials, char user,
              std::map<std::uint64_t, Split>* parts) {
  bool found = false;
  for (const TrialName& trial : trials) {
    if (trial.user != user) continue;
    (*parts)[trial.seed()] = Split::kTest;
    found = true;
  }
  if (found) return;
  throw std::invalid_argument(std::string("user '") + user +
                              "' is to be held out, but no trial is theirs");
}

}  // namespace

std::map<std::uint64_t, Split> AssignParts(const std::vector<TrialName>& trials,
                                           const HoldOut& hold_out) {
  std::map<std::uint64_t, Split> parts;
  for (const TrialName& trial : trials) parts[trial.seed()] = Split::kTrain;
  if (hold_out.user != 0) {
    MoveUser(trials, hold_out.user, &parts);
  } else if (!hold_out.names.empty()) {
    for (const std::string& name : hold_out.names) MoveNamed(trials, name, &parts);
  } else {
    MoveByHash(trials, hold_out.trials, Split::kTest, &parts);
  }
  MoveByHash(trials, hold_out.valid, Split::kValid, &parts);
  const bool some = std::any_of(parts.begin(), parts.end(),
                                [](const auto& part) { return part.second == Split::kTrain; });
  if (!some) {
    throw std::invalid_argument("none of " + std::to_string(trials.size()) +
                                " trials is left to train on: hold out fewer");
  }
  return parts;
}

}  // namespace prospect::model::jigsaws

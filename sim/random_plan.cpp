#include "sim/random_plan.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace prospect::sim {
namespace {

constexpr std::uint64_t kPlanStream = 0x706c616eULL;
constexpr std::uint64_t kRetryStream = 0x7265747279ULL;
constexpr double kRetryTrials = 0.22;  // of which many end before a retry is possible

}  // namespace

RandomPlan::RandomPlan(planner::TaskRules rules, std::uint64_t trial_seed, bool retries)
    : rules_(std::move(rules)),
      random_(base::MixSeeds({trial_seed, kPlanStream})),
      last_(rules_.num_actions),
      attempt_{{}, rules_.plan_length},
      wants_retry_(retries && base::Random(base::MixSeeds({trial_seed, kRetryStream})).Uniform() <
                                  kRetryTrials) {
  if (!rules_.tower.empty()) rules_.Prepare();
}

int RandomPlan::Choose(const std::vector<int>& legal) {
  const std::vector<int> offered = Offered(Useful(legal));
  const int action = offered[random_.Below(static_cast<int>(offered.size()))];
  Note(action);
  return action;
}

void RandomPlan::Follow(int action) {
  if (Retries(action)) wants_retry_ = false;
  Note(action);
}

void RandomPlan::Note(int action) {
  if (!rules_.tower.empty()) {
    if (Retries(action)) attempt_ = planner::BegunAnew(rules_, attempt_);
    attempt_.executed.push_back(static_cast<std::uint8_t>(action));
  }
  last_ = action;
}

// Without what cannot end in one tower any more; all where nothing else is left.
std::vector<int> RandomPlan::Useful(const std::vector<int>& legal) const {
  if (rules_.tower.empty() || attempt_.plan_length > planner::kMaxPathLength) return legal;
  const planner::TaskRules rules = planner::RulesFor(rules_, attempt_);
  std::vector<int> useful;
  std::copy_if(legal.begin(), legal.end(), std::back_inserter(useful), [&](int action) {
    return Retries(action) || rules.Allowed(attempt_.executed, {}, action);
  });
  return useful.empty() ? legal : useful;
}

std::vector<int> RandomPlan::Offered(const std::vector<int>& legal) {
  std::vector<int> onward, retries;
  for (int action : legal) (Retries(action) ? retries : onward).push_back(action);
  if (retries.empty() || onward.empty()) return legal;
  if (!wants_retry_ || random_.Uniform() < 0.5) return onward;
  wants_retry_ = false;
  return retries;
}

}  // namespace prospect::sim

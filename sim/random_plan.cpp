#include "sim/random_plan.h"

#include <utility>

namespace prospect::sim {
namespace {

constexpr std::uint64_t kPlanStream = 0x706c616eULL;
constexpr std::uint64_t kRetryStream = 0x7265747279ULL;
constexpr double kRetryTrials = 0.22;  // of which many end before a retry is possible

}  // namespace

RandomPlan::RandomPlan(std::vector<std::vector<int>> successors, std::uint64_t trial_seed,
                       bool retries)
    : successors_(std::move(successors)),
      random_(MixSeeds({trial_seed, kPlanStream})),
      last_(static_cast<int>(successors_.size()) - 1),
      wants_retry_(retries &&
                   Random(MixSeeds({trial_seed, kRetryStream})).Uniform() < kRetryTrials) {}

int RandomPlan::Choose(const std::vector<int>& legal) {
  const std::vector<int> offered = Offered(legal);
  last_ = offered[random_.Below(static_cast<int>(offered.size()))];
  return last_;
}

void RandomPlan::Follow(int action) {
  if (IsRetry(successors_, last_, action)) wants_retry_ = false;
  last_ = action;
}

std::vector<int> RandomPlan::Offered(const std::vector<int>& legal) {
  const auto is_retry = [this](int action) { return IsRetry(successors_, last_, action); };
  std::vector<int> onward, retries;
  for (int action : legal) (is_retry(action) ? retries : onward).push_back(action);
  if (retries.empty() || onward.empty()) return legal;
  if (!wants_retry_ || random_.Uniform() < 0.5) return onward;
  wants_retry_ = false;
  return retries;
}

}  // namespace prospect::sim

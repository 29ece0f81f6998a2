#include "tools/evaluate/recovery.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "base/random.h"
#include "sim/rollout.h"

namespace prospect::tools {
namespace {

constexpr std::uint64_t kStream = 0x7265636f766572ULL;
constexpr int kRuns = 3;

bool MayBeginAnew(const sim::Task& task) {
  const int last = task.progress().action;
  const std::vector<int> legal = task.LegalActions();
  const auto anew = [&](int action) { return task.spec().IsRetry(last, action); };
  return std::any_of(legal.begin(), legal.end(), anew);
}

// Takes what goes on, the first of several, until the trial is over.
bool GoingOnSucceeds(sim::Task& task) {
  while (task.progress().outcome == sim::Outcome::kRunning) {
    const int last = task.progress().action;
    const std::vector<int> legal = task.LegalActions();
    const auto on = std::find_if(legal.begin(), legal.end(),
                                 [&](int action) { return !task.spec().IsRetry(last, action); });
    if (on == legal.end() || !sim::RunAction(task, *on, nullptr)) break;
  }
  return task.progress().outcome == sim::Outcome::kSuccess;
}

bool Lost(sim::Task& task, const sim::TaskState& here, std::uint64_t scene_seed) {
  bool succeeds = false;
  for (int run = 0; run < kRuns && !succeeds; ++run) {
    task.SetNoiseSeed(base::MixSeeds({scene_seed, kStream, static_cast<std::uint64_t>(run)}));
    succeeds = GoingOnSucceeds(task);
    task.Restore(here);
  }
  return !succeeds;
}

}  // namespace

std::optional<Recovery> ConsultRecovery(sim::Task& task, std::uint64_t scene_seed) {
  if (task.progress().outcome != sim::Outcome::kRunning || !MayBeginAnew(task)) return std::nullopt;
  const std::unique_ptr<sim::TaskState> here = task.Save();
  std::optional<Recovery> recovery;
  if (Lost(task, *here, scene_seed)) {
    sim::OracleOptions options;
    options.begin_anew = true;
    const std::uint64_t seed = base::MixSeeds({scene_seed, kStream});
    recovery = Recovery{sim::ConsultOracle(task, seed, options).scene_class, task.progress().time};
  }
  task.Restore(*here);
  return recovery;
}

}  // namespace prospect::tools

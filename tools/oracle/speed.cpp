#include "tools/oracle/speed.h"

#include <ctime>

#include "sim/plan_rules.h"
#include "sim/random_plan.h"
#include "sim/rollout.h"

namespace prospect::tools {
namespace {

// Takes pictures and throws them away.
class Onlooker : public sim::FrameSink {
 public:
  void OnFrame(const sim::Image&, const sim::Progress&) override {}
};

}  // namespace

double TimesRealTime(sim::Task& task, std::uint64_t seed, bool with_camera) {
  Onlooker onlooker;
  constexpr double kLongEnough = 0.5 * CLOCKS_PER_SEC;
  const std::clock_t start = std::clock();
  double simulated = 0;
  while (static_cast<double>(std::clock() - start) < kLongEnough) {
    task.Reset(seed);
    sim::RandomPlan plan(sim::PlanRules(task.spec()), seed++);
    for (auto legal = task.LegalActions(); !legal.empty(); legal = task.LegalActions()) {
      sim::RunAction(task, plan.Choose(legal), with_camera ? &onlooker : nullptr);
    }
    simulated += task.progress().time;
  }
  return simulated * CLOCKS_PER_SEC / static_cast<double>(std::clock() - start);
}

}  // namespace prospect::tools

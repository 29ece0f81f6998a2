#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/report_file.h"
#include "sim/plan_rules.h"
#include "sim/random_plan.h"
#include "sim/task_factory.h"
#include "tools/bench/commands.h"
#include "tools/bench/cpu_clock.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

// Adds the processor time from its making to its end to *seconds.
class Timed {
 public:
  explicit Timed(double* seconds) : seconds_(seconds), start_(CpuClock::now()) {}
  ~Timed() { *seconds_ += std::chrono::duration<double>(CpuClock::now() - start_).count(); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  double* seconds_;
  CpuClock::time_point start_;
};

struct Costs {
  int ticks = 0;
  int pictures = 0;
  double physics = 0;  // s of processor time: contacts, solver, controllers, verdict
  double camera = 0;
  double resets = 0;
};

void Look(sim::Task& task, Costs* costs) {
  const Timed timed(&costs->camera);
  task.Observe();
  ++costs->pictures;
}

// One trial as the collector runs it, a picture a tick.
void RunTrial(sim::Task& task, std::uint64_t seed, Costs* costs) {
  {
    const Timed timed(&costs->resets);
    task.Reset(seed);
  }
  Look(task, costs);
  sim::RandomPlan plan(sim::PlanRules(task.spec()), seed);
  for (auto legal = task.LegalActions(); !legal.empty(); legal = task.LegalActions()) {
    task.StartAction(plan.Choose(legal));
    while (task.progress().action_state == sim::ActionState::kRunning) {
      {
        const Timed timed(&costs->physics);
        task.Tick();
      }
      ++costs->ticks;
      Look(task, costs);
    }
  }
}

// Keys: task, trials, simulated_seconds, real_time_factor (with the camera), physics_factor
// (without), tick_ms, step_us, picture_ms, reset_ms, camera_share.
json Row(const std::string& name, const cli::BenchSimOptions& options) {
  const auto task = sim::MakeTask(name);
  task->Reset(options.seed);
  task->Observe();  // what is made when it is first needed does not count
  Costs costs;
  for (int i = 0; i < options.trials; ++i) {
    RunTrial(*task, options.seed + static_cast<std::uint64_t>(i), &costs);
  }
  const double simulated = costs.ticks * task->spec().tick_seconds;
  const double physics = costs.physics + costs.resets;
  return {{"task", name},
          {"trials", options.trials},
          {"simulated_seconds", simulated},
          {"real_time_factor", simulated / (physics + costs.camera)},
          {"physics_factor", simulated / physics},
          {"tick_ms", 1e3 * costs.physics / costs.ticks},
          {"step_us", 1e6 * costs.physics * task->spec().step_seconds / simulated},
          {"picture_ms", 1e3 * costs.camera / costs.pictures},
          {"reset_ms", 1e3 * costs.resets / options.trials},
          {"camera_share", costs.camera / (physics + costs.camera)}};
}

void Print(const json& rows) {
  std::printf("%-12s %7s %12s %12s %12s %9s %9s %11s %9s %8s\n", "task", "trials", "simulated s",
              "x real time", "w/o camera", "tick ms", "step us", "picture ms", "reset ms",
              "camera");
  for (const json& row : rows) {
    const auto number = [&](const char* key) { return row[key].get<double>(); };
    std::printf("%-12s %7d %12.0f %12.1f %12.1f %9.3f %9.1f %11.3f %9.2f %6.0f %%\n",
                row["task"].get<std::string>().c_str(), row["trials"].get<int>(),
                number("simulated_seconds"), number("real_time_factor"), number("physics_factor"),
                number("tick_ms"), number("step_us"), number("picture_ms"), number("reset_ms"),
                100 * number("camera_share"));
  }
  std::printf("Processor time of one core; a tick is 0.1 s of simulated time and one picture.\n");
}

}  // namespace

int RunBenchSim(const cli::BenchSimOptions& options) {
  json rows = json::array();
  for (const std::string& task : options.tasks) rows.push_back(Row(task, options));
  if (options.report.talks()) Print(rows);
  cli::WriteReport(options.report, {{"rows", rows}});
  return 0;
}

}  // namespace prospect::tools

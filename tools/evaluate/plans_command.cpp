#include <memory>

#include "cli/report_file.h"
#include "model/engine.h"
#include "sim/task_factory.h"
#include "tools/common/words.h"
#include "tools/common/world.h"
#include "tools/evaluate/commands.h"
#include "tools/evaluate/plan_outcomes.h"
#include "tools/evaluate/plan_scores.h"
#include "tools/evaluate/scene_runs.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

class Bench {
 public:
  // `weights`: a file.
  Bench(const cli::EvaluatePlansOptions& options, const std::string& weights)
      : options_(options),
        world_(WorldOf(options.scene)),
        task_(sim::MakeTask(options.task, world_)),
        engine_(model::LoadSearchEngine(weights, 1)),
        file_(options.outcomes.empty()
                  ? OutcomePath(task_->spec(), world_, options.runs, options.most)
                  : options.outcomes) {}

  PlanScene Run(std::uint64_t seed) {
    return ScorePlans(*task_, *engine_, seed, world_.image_noise, Outcomes(seed), options_.runs);
  }

 private:
  std::vector<PlanOutcome> Outcomes(std::uint64_t seed) {
    if (const auto* known = file_.Find(seed)) return *known;
    task_->Reset(seed);
    const auto outcomes =
        CarryOut(*task_, seed, LegalPlans(*task_, seed, options_.most), options_.runs);
    file_.Store(seed, outcomes);
    return outcomes;
  }

  cli::EvaluatePlansOptions options_;
  sim::TaskOptions world_;
  std::unique_ptr<sim::Task> task_;
  std::unique_ptr<model::Engine> engine_;
  OutcomeFile file_;
};

}  // namespace

int RunPlans(const cli::EvaluatePlansOptions& options) {
  const std::string weights = cli::WeightsFile(options.weights, options.task);
  sim::MakeTask(options.task, WorldOf(options.scene));  // refuses what is out of range early
  RequireWeightsOf(options.task, weights);
  const Items scenes = {
      "scenes", options.scenes, options.jobs,
      SceneSource(options.task, WorldOf(options.scene), model::WeightsFileHash(weights))};
  const SceneRuns runs = RunScenes(options.shard, scenes, options.seed, [&]() -> SceneRun {
    auto bench = std::make_shared<Bench>(options, weights);
    return [bench](std::uint64_t seed) { return bench->Run(seed); };
  });
  if (options.shard.given())
    return WritePart(options.shard, options.report, "evaluate plans", scenes, runs);
  json summary = SummarisePlans(runs.records);
  Words() << PlanTable(summary) << runs.extent.Line("scenes");
  summary["task"] = options.task;
  summary["first_seed"] = options.seed;
  summary["runs"] = options.runs;
  runs.extent.Put(&summary);
  summary["records"] = runs.records;
  cli::WriteReport(options.report, summary);
  return runs.extent.exit_code();
}

}  // namespace prospect::tools

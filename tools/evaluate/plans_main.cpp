// prospect-evaluate-plans: does the model know which plans work? All plans of unseen scenes are
// scored by the networks and each is really carried out many times. Needs no bus.

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "base/json_file.h"
#include "model/engine.h"
#include "sim/task_factory.h"
#include "tools/common/scene_options.h"
#include "tools/common/torch_main.h"
#include "tools/evaluate/plan_outcomes.h"
#include "tools/evaluate/plan_scores.h"
#include "tools/evaluate/scene_runs.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

struct Options {
  std::string task = "navigation";
  std::string weights, json_file, outcomes;
  std::uint64_t seed = 2'000'000;
  int scenes = 20, runs = 10, most = 50, jobs = 2;
  sim::TaskOptions world;
};

void AddOptions(CLI::App* app, Options* o) {
  app->add_flag("--plans")->description("This program: plans instead of closed loops");
  app->add_option("--task", o->task, "Task")->capture_default_str();
  app->add_option("--weights", o->weights, "Weights file")->required();
  app->add_option("--scenes", o->scenes, "Scenes")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app->add_option("--seed", o->seed,
                  "First scene; models are compared and chosen on 1000000 to 1499999, reported on "
                  "2000000 and up")
      ->check(CLI::Range(std::uint64_t{1'000'000}, std::uint64_t{1} << 40))
      ->capture_default_str();
  AddSceneOptions(app, &o->world);
  app->add_option("--runs", o->runs,
                  "Times that each plan is carried out, and as often again for the ceiling")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app->add_option("--most-plans", o->most, "Of more legal plans, so many are drawn")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  app->add_option("--jobs", o->jobs, "Processes")->check(CLI::Range(1, 64))->capture_default_str();
  app->add_option("--outcomes", o->outcomes,
                  "File that keeps how plans fared; empty: under $PROSPECT_DATA/plans");
  app->add_option("--json", o->json_file, "Also write the figures and a record a scene here");
}

class Bench {
 public:
  explicit Bench(const Options& options)
      : options_(options),
        task_(sim::MakeTask(options.task, options.world)),
        engine_(model::LoadSearchEngine(options.weights, 1)),
        file_(options.outcomes.empty()
                  ? OutcomePath(task_->spec(), options.world, options.runs, options.most)
                  : options.outcomes) {}

  PlanScene Run(std::uint64_t seed) {
    return ScorePlans(*task_, *engine_, seed, options_.world.image_noise, Outcomes(seed),
                      options_.runs);
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

  Options options_;
  std::unique_ptr<sim::Task> task_;
  std::unique_ptr<model::Engine> engine_;
  OutcomeFile file_;
};

int Main(int argc, char** argv) {
  Options options;
  CLI::App app("Scores all plans of unseen scenes and carries each out many times");
  AddOptions(&app, &options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  sim::MakeTask(options.task, options.world);  // refuses what is out of range, before any process
  RequireWeightsOf(options.task, options.weights);
  const SceneRuns runs = RunScenes(options.scenes, options.seed, options.jobs, [&]() -> SceneRun {
    auto bench = std::make_shared<Bench>(options);
    return [bench](std::uint64_t seed) { return bench->Run(seed); };
  });
  json summary = SummarisePlans(runs.records);
  std::cout << PlanTable(summary) << runs.extent.Line("scenes");
  if (options.json_file.empty()) return runs.extent.exit_code();
  summary["task"] = options.task;
  summary["first_seed"] = options.seed;
  summary["runs"] = options.runs;
  runs.extent.Put(&summary);
  summary["records"] = runs.records;
  base::WriteJsonFile(options.json_file, summary, 1);
  return runs.extent.exit_code();
}

}  // namespace
}  // namespace prospect::tools

int main(int argc, char** argv) {
  return prospect::tools::RunTorchMain([&] { return prospect::tools::Main(argc, argv); },
                                       "prospect-evaluate-plans");
}

#include "cli/commands/bench.h"

#include "cli/options/common.h"
#include "cli/options/rule.h"
#include "cli/options/weights.h"
#include "cli/values.h"
#include "planner/path.h"

namespace prospect::cli {
namespace {

void DefineWorkers(CLI::App& app, std::vector<int>& workers) {
  app.add_option("--workers", workers, "numbers of workers")
      ->type_name("LIST")
      ->delimiter(',')
      ->transform(Whole(1, 1024))
      ->capture_default_str();
}

void DefineRollouts(CLI::App& app, std::int64_t& samples) {
  app.add_option("--samples", samples, "rollouts a search, of all workers together")
      ->type_name("N")
      ->transform(Whole(1, 10'000'000))
      ->capture_default_str();
}

void DefineTrees(CLI::App& app, int& seeds) {
  app.add_option("--seeds", seeds, "trees that are searched, for each row")
      ->type_name("N")
      ->transform(Whole(1, 1'000'000))
      ->capture_default_str();
}

template <typename Number>
void DefineFirstTree(CLI::App& app, Number& seed) {
  app.add_option("--first-seed", seed, "of the first tree")
      ->type_name("N")
      ->transform(Whole(0, 1'000'000'000))
      ->capture_default_str();
}

void DefineFileOption(CLI::App& app, const std::string& name, std::string& file,
                      const std::string& what) {
  app.add_option(name, file, what)->type_name("FILE");
}

void DefineServers(CLI::App& app, BenchSearchOptions& options) {
  app.add_option("--weights", options.weights, "as prospect-model-server's")
      ->type_name("PATH")
      ->capture_default_str();
  app.add_option("--fixed-cost", options.fixed_cost,
                 "A,B: a batch takes A ms + B ms a row; none: as long as it takes")
      ->type_name("A,B")
      ->capture_default_str();
  app.add_option("--max-batch", options.max_batch, "most paths a batch")
      ->type_name("N")
      ->transform(Whole(1, 256))
      ->capture_default_str();
  DefineThreads(app, options.threads);
  app.add_option("--servers", options.servers, "model servers side by side")
      ->type_name("N")
      ->transform(Whole(1, 64))
      ->capture_default_str();
}

}  // namespace

void Define(CLI::App& app, BenchSearchOptions& options) {
  DefineWorkers(app, options.workers);
  DefineRollouts(app, options.samples);
  DefineTrees(app, options.seeds);
  DefineFirstTree(app, options.first_seed);
  DefineRule(app, options.rule);
  app.add_option(
         "--leaves", options.leaves,
         "evaluations a worker keeps in flight: one number for all, or one for each of --workers")
      ->type_name("LIST")
      ->delimiter(',')
      ->transform(Whole(1, 256))
      ->capture_default_str();
  app.add_option("--plan-length", options.plan_length,
                 "actions in a plan (scripted-tree has its own)")
      ->type_name("N")
      ->transform(Whole(1, planner::kMaxPathLength))
      ->capture_default_str();
  app.add_flag("!--no-sharing", options.sharing,
               "each worker searches a tree of its own, for comparison");
  app.add_flag("!--no-prune", options.prune, "f, V and p cut nothing off: the whole tree is open");
  DefineServers(app, options);
  app.add_flag("--engine-loop", options.engine_loop,
               "beside each row: evaluations/s of the engine alone at the same mean batch");
  app.add_option("--bus", options.bus, "LCM URL")
      ->default_str("a bus of its own")
      ->type_name("URL");
  app.add_option("--logs", options.logs, "folder of the services' logs")
      ->default_str("a temporary one")
      ->type_name("DIR");
  DefineFileOption(app, "--csv", options.csv, "write the table to this file, too");
  DefineFileOption(app, "--plot", options.plot, "draw rollouts/s against workers into this PNG");
  DefineReport(app, options.report);
}

std::string Defect(const BenchSearchOptions& options) {
  if (options.leaves.size() <= 1 || options.leaves.size() == options.workers.size()) return "";
  return "--leaves wants one number, or one for each of --workers";
}

void Define(CLI::App& app, BenchSimulatedOptions& options) {
  DefineRule(app, options.rule);
  DefineWorkers(app, options.workers);
  app.add_option("--arm", options.arms,
                 "a way of searching, such as workers=8,sharing=0,drop=0.3; as often as "
                 "wanted, the first is what the others are compared with")
      ->default_str("one for each number of workers")
      ->type_name("WORDS");
  DefineRollouts(app, options.samples);
  DefineTrees(app, options.seeds);
  DefineFirstTree(app, options.first_seed);
  app.add_option("--threads", options.threads, "trees searched at once")
      ->type_name("N")
      ->transform(Whole(1, 256))
      ->capture_default_str();
  app.add_option("--leaves", options.leaves, "rollouts a worker keeps in flight")
      ->type_name("N")
      ->transform(Whole(1, 64))
      ->capture_default_str();
  DefineFileOption(app, "--csv", options.csv, "write the table to this file, too");
  DefineReport(app, options.report);
}

void Define(CLI::App& app, BenchOverheadOptions& options) {
  DefineRule(app, options.rule);
  app.add_option("--rollouts", options.rollouts, "rollouts of a measurement")
      ->type_name("N")
      ->transform(Whole(1, 10'000'000))
      ->capture_default_str();
  app.add_option("--depth", options.depth, "of the tree")
      ->type_name("N")
      ->transform(Whole(1, planner::kMaxPathLength))
      ->capture_default_str();
  DefineReport(app, options.report);
}

void Define(CLI::App& app, BenchSimOptions& options) {
  app.add_option("--task", options.tasks, "tasks")
      ->default_str("all")
      ->type_name("NAMES")
      ->delimiter(',')
      ->check(OneOf(TaskNames(Tasks::kSimulated)));
  app.add_option("--trials", options.trials, "random trials of each task")
      ->type_name("N")
      ->transform(Whole(1, 100'000))
      ->capture_default_str();
  DefineSeed(app, options.seed, "of the first trial");
  DefineReport(app, options.report);
}

void Define(CLI::App& app, BenchPicksOptions& options) {
  DefineScenes(app, options.scenes, "scenes with a pair of blocks far from the obstacle", 1,
               100'000);
  DefineSeed(app, options.seed, "where the search for such scenes begins");
  app.add_option("--clearance", options.clearance,
                 "metres between the obstacle and both blocks and the line between these")
      ->type_name("X")
      ->check(Real(0, 1))
      ->capture_default_str();
  app.add_option("--noise", options.noise,
                 "scales of the execution noise; 0: none, 1: the scene file's")
      ->type_name("LIST")
      ->delimiter(',')
      ->check(Real(0, 1000))
      ->capture_default_str();
  DefineJobs(app, options.jobs);
  DefineReport(app, options.report);
}

void Define(CLI::App& app, BenchTrainOptions& options) {
  DefineTask(app, options.task, Tasks::kAll);
  app.add_option("--device", options.device, "what computes")
      ->type_name("NAME")
      ->check(OneOf({"cpu", "cuda"}))
      ->capture_default_str();
  app.add_option("--precision", options.precision, "as train's")
      ->type_name("NAME")
      ->check(OneOf({"float32", "mixed", "auto"}))
      ->capture_default_str();
  DefineThreads(app, options.threads);
  app.add_option("--seconds", options.seconds, "about so long each stage is measured")
      ->type_name("S")
      ->check(Real(0, 3600))
      ->capture_default_str();
  DefineReport(app, options.report);
}

void Define(CLI::App& app, BenchEngineOptions& options) {
  DefineTask(app, options.task, Tasks::kAll);
  DefineWeightsFile(app, options.weights);
  app.add_option("--batches", options.batches, "rows a question")
      ->type_name("LIST")
      ->delimiter(',')
      ->transform(Whole(1, 1024))
      ->capture_default_str();
  app.add_option("--pairs", options.pairs, "measurements of each engine, taken in turns")
      ->type_name("N")
      ->transform(Whole(1, 1000))
      ->capture_default_str();
  app.add_option("--scenes", options.scenes,
                 "scenes on which answers and plans of both are compared")
      ->type_name("N")
      ->transform(Whole(1, 100'000))
      ->capture_default_str();
  DefineReport(app, options.report);
}

}  // namespace prospect::cli

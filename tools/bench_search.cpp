// prospect-bench search: what the search itself costs, and what more workers give.
//   overhead  selection and backup, microseconds a rollout on one core, with the model's own time
//             taken out: in a tree that grows, and in one that is wholly known
//   workers   rollouts a second of simulated time, around one batching server (tools/bench)

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/baseline_plans.h"
#include "planner/scripted_model.h"
#include "planner/search.h"
#include "tools/bench/simulated_bus.h"

namespace {

using nlohmann::json;
using namespace prospect;
using Clock = std::chrono::steady_clock;

struct Options {
  std::string rule = "paper";
  std::int64_t rollouts = 20'000;
  int depth = 10;
  std::vector<int> workers = {1, 2, 4, 8, 16};
  std::int64_t samples = 400;
  int seeds = 20;
  int leaves = 2;
  std::string json_file;
};

void AddOptions(CLI::App* app, Options* options) {
  app->add_option("--rule", options->rule, "The selection rule")->capture_default_str();
  app->add_option("--rollouts", options->rollouts, "Rollouts of the overhead measurement")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  app->add_option("--depth", options->depth, "Depth of the overhead measurement")
      ->check(CLI::Range(1, 32))
      ->capture_default_str();
  app->add_option("--workers", options->workers, "Numbers of workers")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app->add_option("--samples", options->samples, "Rollouts of all workers together")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app->add_option("--seeds", options->seeds, "Trees for each number of workers")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  app->add_option("--leaves", options->leaves, "Rollouts a worker keeps in flight")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app->add_option("--json", options->json_file, "Write the figures to this file, too");
}

double Seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

planner::ScriptedModel OpenModel(int num_actions) {
  planner::ScriptedModelParameters parameters;
  parameters.num_actions = num_actions;
  parameters.failing = parameters.hopeless = parameters.forbidden = 0;
  return planner::ScriptedModel(parameters);
}

planner::SearchParameters ParametersOf(const Options& options) {
  planner::SearchParameters parameters;
  parameters.rule = options.rule;
  parameters.samples = options.rollouts;
  return parameters;
}

// Runs the search with the model's own time taken out.
Clock::duration TimeSearch(planner::Search* search, planner::ModelSource* model) {
  Clock::duration spent{};
  while (!search->finished(0)) {
    const auto before = Clock::now();
    const std::vector<planner::Path> asked = search->Advance(search->waiting() > 0 ? 0 : 1, 0);
    spent += Clock::now() - before;
    const std::vector<planner::Evaluation> answers = model->EvaluateBatch(asked);
    const auto between = Clock::now();
    for (std::size_t i = 0; i < asked.size(); ++i) search->Deliver(asked[i], answers[i], 0);
    spent += Clock::now() - between;
  }
  return spent;
}

json OverheadRow(const char* tree, int num_actions, int depth, const planner::Search& search,
                 Clock::duration spent) {
  const double us = 1e6 * Seconds(spent) / static_cast<double>(search.rollouts());
  return {{"tree", tree},
          {"actions", num_actions},
          {"depth", depth},
          {"rollouts", search.rollouts()},
          {"evaluations", search.evaluations()},
          {"us_per_rollout", us},
          {"rollouts_per_s", 1e6 / us}};
}

// Microseconds a rollout spends in Search, with `num_actions` children a node: first in a tree that
// grows, taking in and storing every evaluation, then the same rollouts over what is known by then.
void MeasureOverhead(const Options& options, int num_actions, json* rows) {
  const planner::TaskRules rules = planner::AnyOrder(num_actions, options.depth, true);
  planner::ScriptedModel model = OpenModel(num_actions);
  planner::Search growing(rules, ParametersOf(options), {}, {});
  const Clock::duration spent = TimeSearch(&growing, &model);
  rows->push_back(OverheadRow("growing", num_actions, options.depth, growing, spent));

  planner::Search known(rules, ParametersOf(options), {}, {});
  for (planner::PathId id = 0; id < growing.paths().size(); ++id) {
    if (!growing.evaluation_table().Has(id)) continue;
    known.Deliver(growing.paths().PathOf(id), growing.evaluation_table().Get(id), 0);
  }
  const Clock::duration again = TimeSearch(&known, &model);
  rows->push_back(OverheadRow("known", num_actions, options.depth, known, again));
}

json MeasureWorkers(const Options& options, int workers) {
  tools::BusOptions bus;
  bus.rules = planner::AnyOrder(7, 5);
  bus.parameters.rule = options.rule;
  bus.parameters.samples = options.samples;
  bus.workers = workers;
  bus.leaves = options.leaves;
  double seconds = 0, rollouts = 0, evaluations = 0, batches = 0, optimal = 0;
  for (int seed = 0; seed < options.seeds; ++seed) {
    bus.seed = static_cast<std::uint64_t>(seed);
    const tools::BusResult result = tools::SimulateBus(bus);
    planner::ScriptedModelParameters scripted;
    scripted.num_actions = bus.rules.num_actions;
    scripted.seed = bus.seed;
    planner::ScriptedModel model(scripted);
    const planner::Plan best = planner::ExhaustivePlan(bus.rules, bus.parameters, {}, &model).plan;
    seconds += 1e-6 * static_cast<double>(result.simulated_us);
    rollouts += static_cast<double>(result.rollouts);
    evaluations += static_cast<double>(result.evaluations);
    batches += static_cast<double>(result.batches);
    optimal += result.score == (best.ok() ? best.best.score : 0) ? 1 : 0;
  }
  return {{"workers", workers},
          {"rollouts", rollouts / options.seeds},
          {"rollouts_per_s", rollouts / seconds},
          {"evaluations_per_s", evaluations / seconds},
          {"mean_batch", evaluations / batches},
          {"optimal_rate", optimal / options.seeds}};
}

json Measure(const Options& options) {
  json overhead = json::array();
  for (const int actions : {4, 7, 36}) MeasureOverhead(options, actions, &overhead);
  json rows = json::array();
  for (const int workers : options.workers) rows.push_back(MeasureWorkers(options, workers));
  return {{"rule", options.rule}, {"overhead", overhead}, {"rows", rows}};
}

void Print(const json& report) {
  std::printf("search overhead, rule %s\n", report["rule"].get<std::string>().c_str());
  std::printf("%8s %8s %6s %10s %12s %14s\n", "tree", "actions", "depth", "rollouts", "evaluations",
              "us a rollout");
  for (const json& row : report["overhead"]) {
    std::printf("%8s %8d %6d %10d %12d %14.2f\n", row["tree"].get<std::string>().c_str(),
                row["actions"].get<int>(), row["depth"].get<int>(), row["rollouts"].get<int>(),
                row["evaluations"].get<int>(), row["us_per_rollout"].get<double>());
  }
  std::printf("\nworkers around one server of 4 ms + 0.02 ms a row (simulated time)\n");
  std::printf("%8s %10s %12s %14s %11s %13s\n", "workers", "rollouts", "rollouts/s",
              "evaluations/s", "mean batch", "optimal rate");
  for (const json& row : report["rows"]) {
    std::printf("%8d %10.1f %12.1f %14.1f %11.2f %13.2f\n", row["workers"].get<int>(),
                row["rollouts"].get<double>(), row["rollouts_per_s"].get<double>(),
                row["evaluations_per_s"].get<double>(), row["mean_batch"].get<double>(),
                row["optimal_rate"].get<double>());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Benchmarks that need no bus");
  app.require_subcommand(1);
  Options options;
  CLI::App* search = app.add_subcommand("search", "The search alone, with scripted models");
  AddOptions(search, &options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    const json report = Measure(options);
    Print(report);
    if (!options.json_file.empty()) std::ofstream(options.json_file) << report.dump(2) << '\n';
  } catch (const std::exception& error) {
    std::fprintf(stderr, "prospect-bench: %s\n", error.what());
    return 1;
  }
  return 0;
}

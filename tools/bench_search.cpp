// prospect-bench search: what the search itself costs, and what more workers give.
//   overhead   selection and backup, microseconds a rollout on one core, with the model's own time
//              taken out: in a tree that grows, and in one that is wholly known
//   simulated  workers around one batching server on a virtual clock (tools/bench/simulated_bus.h):
//              rollouts a second, decisions against the best there is, what sharing costs, what
//              holds it up; --arm compares ways of searching. --simulated leaves the overhead out.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "planner/scripted_model.h"
#include "planner/search.h"
#include "tools/bench/cpu_clock.h"
#include "tools/bench/simulated_arms.h"
#include "tools/common/program.h"

namespace {

using nlohmann::json;
using namespace prospect;
using Clock = tools::CpuClock;

struct Options {
  std::string rule = "paper";
  std::int64_t rollouts = 20'000;
  int depth = 10;
  std::vector<int> workers = {1, 2, 4, 8, 16};
  std::vector<std::string> arms;
  bool simulated = false;
  std::int64_t samples = 800;
  int seeds = 20;
  int first_seed = 0;
  int threads = 1;
  int leaves = 2;
  std::string json_file;
  std::string csv_file;
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
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app->add_option("--samples", options->samples, "Rollouts of all workers together")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app->add_flag("--simulated", options->simulated, "Only the simulated workers");
  app->add_option("--arm", options->arms,
                  "A way of searching, such as workers=8,sharing=0,drop=0.3; as often as "
                  "wanted, the first is what the others are compared with. Default: one for each "
                  "number of workers");
  app->add_option("--first-seed", options->first_seed, "Seed of the first tree")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str();
  app->add_option("--threads", options->threads, "Trees searched at once")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app->add_option("--csv", options->csv_file, "Write the arms as comma-separated values, too");
  app->add_option("--seeds", options->seeds, "Trees for each arm")
      ->check(CLI::Range(1, 1'000'000))
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

std::vector<tools::Arm> ArmsOf(const Options& options) {
  tools::BusOptions defaults;
  defaults.parameters.rule = options.rule;
  defaults.parameters.samples = options.samples;
  defaults.leaves = options.leaves;
  std::vector<tools::Arm> arms;
  for (const std::string& text : options.arms) arms.push_back(tools::ParseArm(text, defaults));
  if (!arms.empty()) return arms;
  for (const int workers : options.workers) {
    arms.push_back(tools::ParseArm("workers=" + std::to_string(workers), defaults));
  }
  return arms;
}

json Measure(const Options& options) {
  json overhead = json::array();
  if (!options.simulated) {
    for (const int actions : {4, 7, 36}) MeasureOverhead(options, actions, &overhead);
  }
  const json rows =
      tools::RunArms(ArmsOf(options), options.first_seed, options.seeds, options.threads);
  return {{"rule", options.rule}, {"overhead", overhead}, {"rows", rows}};
}

void PrintOverhead(const json& rows) {
  std::printf("%8s %8s %6s %10s %12s %14s\n", "tree", "actions", "depth", "rollouts", "evaluations",
              "us a rollout");
  for (const json& row : rows) {
    std::printf("%8s %8d %6d %10d %12d %14.2f\n", row["tree"].get<std::string>().c_str(),
                row["actions"].get<int>(), row["depth"].get<int>(), row["rollouts"].get<int>(),
                row["evaluations"].get<int>(), row["us_per_rollout"].get<double>());
  }
  std::printf("\n");
}

void Print(const json& report) {
  std::printf("rule %s\n", report["rule"].get<std::string>().c_str());
  if (!report["overhead"].empty()) PrintOverhead(report["overhead"]);
  std::printf("workers around one server of 4 ms + 0.02 ms a row (virtual clock)\n");
  tools::PrintArms(report["rows"]);
}

void Write(const std::string& file, const std::string& text) {
  if (file.empty()) return;
  base::WriteFile(file, text);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Benchmarks that need no bus");
  app.require_subcommand(1);
  Options options;
  CLI::App* search = app.add_subcommand("search", "The search alone, with scripted models");
  AddOptions(search, &options);
  const auto run = [&] {
    const json report = Measure(options);
    Print(report);
    Write(options.json_file, report.dump(2) + '\n');
    Write(options.csv_file, tools::ArmsAsCsv(report["rows"]));
    return 0;
  };
  return tools::RunProgram("prospect-bench", &app, argc, argv, run, kExitUnexpected);
}

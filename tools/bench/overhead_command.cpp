#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/report_file.h"
#include "planner/scripted_model.h"
#include "planner/search.h"
#include "tools/bench/commands.h"
#include "tools/bench/cpu_clock.h"

namespace prospect::tools {
namespace {

using nlohmann::json;
using Clock = CpuClock;

double Seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

planner::ScriptedModel OpenModel(int num_actions) {
  planner::ScriptedModelParameters parameters;
  parameters.num_actions = num_actions;
  parameters.failing = parameters.hopeless = parameters.forbidden = 0;
  return planner::ScriptedModel(parameters);
}

planner::SearchParameters ParametersOf(const cli::BenchOverheadOptions& options) {
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
void MeasureOverhead(const cli::BenchOverheadOptions& options, int num_actions, json* rows) {
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

void PrintOverhead(const json& rows) {
  std::printf("%8s %8s %6s %10s %12s %14s\n", "tree", "actions", "depth", "rollouts", "evaluations",
              "us a rollout");
  for (const json& row : rows) {
    std::printf("%8s %8d %6d %10d %12d %14.2f\n", row["tree"].get<std::string>().c_str(),
                row["actions"].get<int>(), row["depth"].get<int>(), row["rollouts"].get<int>(),
                row["evaluations"].get<int>(), row["us_per_rollout"].get<double>());
  }
}

}  // namespace

int RunBenchOverhead(const cli::BenchOverheadOptions& options) {
  json rows = json::array();
  for (const int actions : {4, 7, 36}) MeasureOverhead(options, actions, &rows);
  if (options.report.talks()) {
    std::printf("rule %s\n", options.rule.c_str());
    PrintOverhead(rows);
  }
  cli::WriteReport(options.report, {{"rule", options.rule}, {"overhead", rows}});
  return 0;
}

}  // namespace prospect::tools

// prospect-bus-bench: what more planner workers give, measured over a bus with the real programs.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <tuple>

#include "base/json_file.h"
#include "base/run_main.h"
#include "planner/selection_rule.h"
#include "report/scaling_plot.h"
#include "services/bench/bench_report.h"
#include "services/bench/engine_loop.h"
#include "services/bench/search_bench.h"
#include "services/common/common_options.h"
#include "services/common/signals.h"
#include "services/model/engine_choice.h"

namespace {

using namespace prospect;
using namespace prospect::services;
using nlohmann::json;

struct Options {
  CommonOptions common;
  SearchBenchOptions bench;
  std::string json_file, csv_file, plot_file;
  std::string logs;
  bool engine_loop = false;
};

void AddSearchOptions(CLI::App& app, SearchBenchOptions& bench) {
  app.add_option("--workers", bench.workers, "numbers of workers")
      ->delimiter(',')
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--samples", bench.samples, "rollouts a search, of all workers together")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  app.add_option("--seeds", bench.seeds, "searches for each number of workers")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--first-seed", bench.first_seed, "the first tree")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--rule", bench.rule, "selection rule")
      ->check(CLI::IsMember(prospect::planner::SelectionRuleNames()))
      ->capture_default_str();
  app.add_option(
         "--leaves", bench.leaves,
         "evaluations a worker keeps in flight: one number for all, or one for each of --workers")
      ->delimiter(',')
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--plan-length", bench.plan_length,
                 "actions in a plan (scripted-tree has its own)")
      ->check(CLI::Range(1, 32))
      ->capture_default_str();
  app.add_flag("!--no-sharing", bench.sharing,
               "each worker searches a tree of its own, for comparison");
  app.add_flag("!--no-prune", bench.prune, "f, V and p cut nothing off: the whole tree is open");
}

void AddServerOptions(CLI::App& app, SearchBenchOptions& bench) {
  app.add_option("--weights", bench.weights, "as prospect-model-server's")->capture_default_str();
  app.add_option("--fixed-cost", bench.fixed_cost,
                 "A,B: a batch takes A ms + B ms a row; none: as long as it takes")
      ->capture_default_str();
  app.add_option("--max-batch", bench.max_batch, "most paths a batch")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--threads", bench.threads, "threads of the networks")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--servers", bench.servers, "model servers side by side")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
}

void AddOutputOptions(CLI::App& app, Options& options) {
  app.add_option("--json", options.json_file, "write the figures to this file, too");
  app.add_option("--csv", options.csv_file, "write the table to this file, too");
  app.add_option("--plot", options.plot_file, "draw rollouts/s against workers into this PNG");
  app.add_flag("--engine-loop", options.engine_loop,
               "beside each row: evaluations/s of the engine's own loop at the same mean batch");
  app.add_option("--logs", options.logs, "folder for the services' logs")->capture_default_str();
}

// Runs when the services are idle, in this process.
void AddEngineLoop(const Options& options, json* row) {
  EngineChoice choice;
  choice.weights = options.bench.weights;
  choice.threads = options.bench.threads;
  if (options.bench.fixed_cost != "none") choice.fixed_cost = options.bench.fixed_cost;
  const double alone = EngineLoopRate(*MakeEngine(choice), row->at("mean_batch").get<double>());
  (*row)["engine_loop_per_s"] = alone;
  (*row)["engine_share"] = row->at("evaluations_per_s").get<double>() / alone;
  std::printf(
      "        the engine alone, same mean batch: %.1f evaluations/s; share %.3f; round trip "
      "less computing p50 %.3f ms\n",
      alone, (*row)["engine_share"].get<double>(), (*row)["overhead_ms_p50"].get<double>());
}

struct Crowd {
  int workers, leaves;
};

// Fewest workers first: a crew only grows.
std::vector<Crowd> CrowdsOf(const SearchBenchOptions& bench) {
  std::vector<Crowd> crowds;
  for (std::size_t i = 0; i < bench.workers.size(); ++i)
    crowds.push_back({bench.workers[i], bench.leaves[bench.leaves.size() > 1 ? i : 0]});
  std::sort(crowds.begin(), crowds.end(), [](const Crowd& a, const Crowd& b) {
    return std::tie(a.workers, a.leaves) < std::tie(b.workers, b.leaves);
  });
  return crowds;
}

json Measure(const Options& options) {
  Bus bus(options.common.bus);
  Conversation talk(bus);
  talk.monitor().RequireOwnBus();
  SearchBench bench(talk, options.bench, options.logs);
  const std::vector<Crowd> crowds = CrowdsOf(options.bench);
  json rows = json::array();
  std::vector<SearchRun> first;
  std::cout << TableHead() << std::flush;
  for (const Crowd& crowd : crowds) {
    const auto runs = bench.Measure(crowd.workers, crowd.leaves);
    if (first.empty()) first = runs;
    json row = RowOf(crowd.workers, runs, options.bench);
    row["leaves"] = crowd.leaves;
    AddSpeedup(first, runs, &row);
    std::cout << TableLine(row) << std::flush;
    if (options.engine_loop) AddEngineLoop(options, &row);
    rows.push_back(row);
  }
  return rows;
}

void WriteFiles(const Options& options, const json& rows) {
  const auto& bench = options.bench;
  const json report = {{"rule", bench.rule},
                       {"weights", bench.weights},
                       {"fixed_cost", bench.fixed_cost},
                       {"max_batch", bench.max_batch},
                       {"servers", bench.servers},
                       {"samples", bench.samples},
                       {"leaves", bench.leaves},
                       {"rows", rows}};
  if (!options.json_file.empty()) prospect::base::WriteJsonFile(options.json_file, report);
  if (!options.csv_file.empty()) WriteCsv(options.csv_file, rows);
  if (!options.plot_file.empty()) {
    prospect::report::WriteScalingPlot(options.plot_file, rows,
                                       bench.weights + ", batch " + bench.fixed_cost +
                                           " ms, up to " + std::to_string(bench.max_batch));
  }
}

int Run(int argc, char** argv) {
  CLI::App app("Searches over a bus with more and more workers: speed, batches, decisions, bytes");
  Options options;
  options.logs =
      (std::filesystem::temp_directory_path() / ("prospect-bench-" + std::to_string(getpid())))
          .string();
  AddCommonOptions(app, options.common);
  AddSearchOptions(app, options.bench);
  AddServerOptions(app, options.bench);
  AddOutputOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  const auto& bench = options.bench;
  if (bench.leaves.size() > 1 && bench.leaves.size() != bench.workers.size())
    throw ExitError(kExitUsage, "--leaves wants one number, or one for each of --workers");
  ApplyCommonOptions(options.common, "bench");
  WriteFiles(options, Measure(options));
  return kExitSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}

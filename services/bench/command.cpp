#include "services/bench/command.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <tuple>

#include "cli/report_file.h"
#include "report/scaling_plot.h"
#include "services/bench/bench_report.h"
#include "services/bench/engine_alone.h"
#include "services/bench/search_bench.h"
#include "services/common/common_options.h"

namespace prospect::services {
namespace {

using nlohmann::json;

std::string LogsOf(const cli::BenchSearchOptions& options) {
  if (!options.logs.empty()) return options.logs;
  return std::filesystem::temp_directory_path() / ("prospect-bench-" + std::to_string(getpid()));
}

// Runs when the services are idle.
void AddEngineLoop(const cli::BenchSearchOptions& options, json* row) {
  const double alone = EngineAlone(options, row->at("mean_batch").get<double>());
  (*row)["engine_loop_per_s"] = alone;
  (*row)["engine_share"] = row->at("evaluations_per_s").get<double>() / alone;
  if (!options.report.talks()) return;
  std::printf(
      "        the engine alone, same mean batch: %.1f evaluations/s; share %.3f; round trip "
      "less computing p50 %.3f ms\n",
      alone, (*row)["engine_share"].get<double>(), (*row)["overhead_ms_p50"].get<double>());
}

struct Crowd {
  int workers, leaves;
};

// Fewest workers first: a crew only grows.
std::vector<Crowd> CrowdsOf(const cli::BenchSearchOptions& bench) {
  std::vector<Crowd> crowds;
  for (std::size_t i = 0; i < bench.workers.size(); ++i)
    crowds.push_back({bench.workers[i], bench.leaves[bench.leaves.size() > 1 ? i : 0]});
  std::sort(crowds.begin(), crowds.end(), [](const Crowd& a, const Crowd& b) {
    return std::tie(a.workers, a.leaves) < std::tie(b.workers, b.leaves);
  });
  return crowds;
}

json Measure(const cli::BenchSearchOptions& options) {
  Bus bus(options.bus);
  Conversation talk(bus);
  talk.monitor().RequireOwnBus();
  SearchBench bench(talk, options, LogsOf(options));
  const std::vector<Crowd> crowds = CrowdsOf(options);
  json rows = json::array();
  std::vector<SearchRun> first;
  if (options.report.talks()) std::cout << TableHead() << std::flush;
  for (const Crowd& crowd : crowds) {
    const auto runs = bench.Measure(crowd.workers, crowd.leaves);
    if (first.empty()) first = runs;
    json row = RowOf(crowd.workers, runs, options);
    row["leaves"] = crowd.leaves;
    AddSpeedup(first, runs, &row);
    if (options.report.talks()) std::cout << TableLine(row) << std::flush;
    if (options.engine_loop) AddEngineLoop(options, &row);
    rows.push_back(row);
  }
  return rows;
}

void WriteFiles(const cli::BenchSearchOptions& bench, const json& rows) {
  const json report = {{"rule", bench.rule},
                       {"weights", bench.weights},
                       {"fixed_cost", bench.fixed_cost},
                       {"max_batch", bench.max_batch},
                       {"servers", bench.servers},
                       {"samples", bench.samples},
                       {"leaves", bench.leaves},
                       {"rows", rows}};
  cli::WriteReport(bench.report, report);
  if (!bench.csv.empty()) WriteCsv(bench.csv, rows);
  if (!bench.plot.empty()) {
    report::WriteScalingPlot(bench.plot, rows,
                             bench.weights + ", batch " + bench.fixed_cost + " ms, up to " +
                                 std::to_string(bench.max_batch));
  }
}

}  // namespace

int RunBenchSearch(const cli::BenchSearchOptions& options) {
  CommonOptions common;
  common.bus = options.bus;
  ApplyCommonOptions(common, "bench");
  WriteFiles(options, Measure(options));
  return kExitSuccess;
}

}  // namespace prospect::services

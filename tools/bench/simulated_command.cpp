#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/atomic_file.h"
#include "cli/report_file.h"
#include "tools/bench/commands.h"
#include "tools/bench/simulated_arms.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

std::vector<Arm> ArmsOf(const cli::BenchSimulatedOptions& options) {
  BusOptions defaults;
  defaults.parameters.rule = options.rule;
  defaults.parameters.samples = options.samples;
  defaults.leaves = options.leaves;
  std::vector<Arm> arms;
  for (const std::string& text : options.arms) arms.push_back(ParseArm(text, defaults));
  if (!arms.empty()) return arms;
  for (const int workers : options.workers) {
    arms.push_back(ParseArm("workers=" + std::to_string(workers), defaults));
  }
  return arms;
}

}  // namespace

int RunBenchSimulated(const cli::BenchSimulatedOptions& options) {
  const json rows = RunArms(ArmsOf(options), options.first_seed, options.seeds, options.threads);
  if (options.report.talks()) {
    std::printf("rule %s\nworkers around one server of 4 ms + 0.02 ms a row (virtual clock)\n",
                options.rule.c_str());
    PrintArms(rows);
  }
  if (!options.csv.empty()) base::WriteFile(options.csv, ArmsAsCsv(rows));
  cli::WriteReport(options.report, {{"rule", options.rule}, {"rows", rows}});
  return 0;
}

}  // namespace prospect::tools

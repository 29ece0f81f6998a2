#include <algorithm>
#include <iostream>

#include "cli/report_file.h"
#include "planner/goal.h"
#include "services/on_bus/bus_bench.h"
#include "tools/common/extent.h"
#include "tools/common/progress.h"
#include "tools/common/words.h"
#include "tools/evaluate/commands.h"
#include "tools/evaluate/episode.h"
#include "tools/evaluate/record_file.h"
#include "tools/evaluate/report.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

// The planner is what the others are compared with.
std::vector<std::string> RowsOf(const cli::EvaluateOnBusOptions& options) {
  std::vector<std::string> rows = options.rows;
  if (std::find(rows.begin(), rows.end(), "planner") == rows.end())
    rows.insert(rows.begin(), "planner");
  return rows;
}

// What records depend on: those made with others are not gone on with.
json KeyOf(const cli::EvaluateOnBusOptions& options, const services::BusBench& bench) {
  const cli::EpisodeOptions& asked = options.episode;
  return {{"task", bench.task()},
          {"weights", bench.weights()},
          {"rows", RowsOf(options)},
          {"first_seed", asked.seed},
          {"goal", asked.goal},
          {"samples", asked.samples},
          {"rule", asked.rule},
          {"depth", asked.depth},
          {"reset", options.reset},
          {"retries", options.retries},
          {"surprise", options.surprise.value_or(-1)},
          {"novelty", asked.refusal.novelty},
          {"threshold", asked.refusal.threshold.value_or(-1)},
          {"refuse_at_most", asked.refusal.promise.refuse_at_most.value_or(-1)},
          {"fail_at_most", asked.refusal.promise.fail_at_most.value_or(-1)}};
}

// All rows on one scene. Each begins in turn, so that what wears off or warms up favours none.
json RunScene(services::BusBench& bench, std::vector<std::string> rows, std::int64_t number,
              std::int64_t seed) {
  std::rotate(rows.begin(), rows.begin() + number % static_cast<std::int64_t>(rows.size()),
              rows.end());
  json scene = {{"seed", seed}, {"rows", json::object()}};
  for (const std::string& row : rows) scene["rows"][row] = ToJson(MeasuredOf(bench.Run(row, seed)));
  return scene;
}

// Those that are missing. Stopped by a signal it keeps what it has.
Extent RunMissing(services::BusBench& bench, const cli::EvaluateOnBusOptions& options,
                  RecordFile* file) {
  const std::vector<std::string> rows = RowsOf(options);
  Progress progress("scenes", options.episodes);
  Extent extent{0, options.episodes};
  try {
    for (; extent.done < options.episodes; ++extent.done) {
      const std::int64_t seed = options.episode.seed + extent.done;
      if (!file->records().contains(static_cast<std::uint64_t>(seed)))
        file->Store(RunScene(bench, rows, extent.done, seed));
      progress.Step();
    }
  } catch (const ExitError& error) {
    if (error.code() != kExitInterrupted) throw;
    std::cerr << error.what() << "\n";
  }
  return extent;
}

std::vector<SceneRecord> RecordsOf(const RecordFile& file, const Extent& extent,
                                   std::int64_t first_seed) {
  std::vector<SceneRecord> records;
  for (int i = 0; i < extent.done; ++i)
    records.push_back(file.records().at(static_cast<std::uint64_t>(first_seed + i)));
  return records;
}

}  // namespace

int RunOnBus(const cli::EvaluateOnBusOptions& options) {
  services::BusBench bench(options);
  RecordFile file(options.episode.out + "/on-bus.jsonl", KeyOf(options, bench));
  const Extent extent = RunMissing(bench, options, &file);
  const std::vector<SceneRecord> records = RecordsOf(file, extent, options.episode.seed);
  const std::vector<std::string> rows = RowsOf(options);
  json report = SummariseUnclassed(records, rows);
  Words() << UnclassedTable(report, rows) << extent.Line("scenes");
  if (!options.reset)
    Words() << "  (scenes as they stood: what was compared were not equal ones)\n";
  report.update(KeyOf(options, bench));
  extent.Put(&report);
  report["records"] = records;
  cli::WriteReport(options.episode.report, report);
  return extent.exit_code();
}

}  // namespace prospect::tools

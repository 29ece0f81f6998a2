#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/report_file.h"
#include "tools/collect/collector.h"
#include "tools/collect/gesture_videos.h"
#include "tools/common/causes.h"
#include "tools/data/commands.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

// What both kinds of collection count. Keys: task, trials, kept, reasons, frames,
// simulated_seconds, wall_seconds, out.
template <typename Summary>
json Report(const cli::CollectOptions& options, const Summary& summary) {
  return {{"task", options.task},
          {"trials", summary.trials},
          {"kept", summary.kept},
          {"reasons", summary.failures},
          {"frames", summary.frames},
          {"simulated_seconds", summary.simulated_seconds},
          {"wall_seconds", summary.wall_seconds},
          {"out", options.out}};
}

void Print(const cli::CollectOptions& options, const CollectSummary& summary) {
  std::printf("%d trials (%d kept from before), %lld frames in %s\n", summary.trials, summary.kept,
              static_cast<long long>(summary.frames), options.out.c_str());
  std::printf("successes  %d (%.1f %%)\n", summary.successes,
              100.0 * summary.successes / summary.trials);
  PrintCauses(summary.failures, summary.trials, stdout);
  std::printf("%.0f s simulated in %.1f s\n", summary.simulated_seconds, summary.wall_seconds);
}

#ifdef PROSPECT_HAS_VIDEOS
void Print(const cli::CollectOptions& options, const GestureVideoSummary& summary) {
  int failed = 0;
  for (const auto& [reason, count] : summary.failures) failed += count;
  std::printf("%d SIMULATED trials (%d kept from before), %lld frames in %s/Suturing\n",
              summary.trials, summary.kept, static_cast<long long>(summary.frames),
              options.out.c_str());
  std::printf("%d trials %s\n", failed, options.failures ? "failed" : "failed and were done again");
  PrintCauses(summary.failures, summary.trials, stdout);
  std::printf("%.0f s of video in %.1f s\n", summary.simulated_seconds, summary.wall_seconds);
}

int CollectVideos(const cli::CollectOptions& options) {
  const GestureVideoSummary summary = CollectGestureVideos(options);
  if (options.report.talks()) Print(options, summary);
  cli::WriteReport(options.report, Report(options, summary));
  return 0;
}
#else
int CollectVideos(const cli::CollectOptions&) {
  throw CollectUsageError("this build writes no videos");
}
#endif

}  // namespace

int RunCollect(const cli::CollectOptions& options) {
  if (options.format == "jigsaws") return CollectVideos(options);
  const CollectSummary summary = Collect(options);
  json report = Report(options, summary);
  report["successes"] = summary.successes;
  report["failures"] = ByCause(summary.failures);
  if (options.report.talks()) Print(options, summary);
  cli::WriteReport(options.report, report);
  return 0;
}

}  // namespace prospect::tools

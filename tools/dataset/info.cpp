#include "tools/dataset/info.h"

#include <algorithm>
#include <cmath>

#include "tools/common/causes.h"
#include "tools/common/parts.h"
#include "tools/dataset/action_table.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

struct Segments {
  std::vector<double> seconds;
  int succeeded = 0;
};

void AddSegments(const model::Trial& trial, std::map<int, Segments>* of_action) {
  std::vector<int> frames(static_cast<std::size_t>(trial.segments()));
  std::vector<int> action(frames.size());
  for (std::size_t i = 0; i < trial.actions.size(); ++i) {
    if (trial.segment[i] < 0) continue;
    ++frames[static_cast<std::size_t>(trial.segment[i])];
    action[static_cast<std::size_t>(trial.segment[i])] = trial.actions[i];
  }
  for (std::size_t k = 0; k < frames.size(); ++k) {
    Segments& segments = (*of_action)[action[k]];
    segments.seconds.push_back(frames[k] * trial.tick_seconds);
    segments.succeeded += trial.segment_succeeded[k];
  }
}

double Percentile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(
      std::lround(share * static_cast<double>(sorted.size() - 1)))];
}

SegmentLengths Measure(const std::string& name, Segments segments) {
  std::sort(segments.seconds.begin(), segments.seconds.end());
  SegmentLengths lengths;
  lengths.action = name;
  lengths.count = static_cast<int>(segments.seconds.size());
  lengths.succeeded = segments.succeeded;
  lengths.low = Percentile(segments.seconds, 0.05);
  lengths.median = Percentile(segments.seconds, 0.5);
  lengths.high = Percentile(segments.seconds, 0.95);
  return lengths;
}

std::map<std::string, int> Reasons(const model::DataSetSummary& summary) {
  std::map<std::string, int> reasons;
  for (const auto& [reason, count] : summary.failures) reasons[reason] = static_cast<int>(count);
  return reasons;
}

double Percent(std::size_t part, std::size_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole));
}

}  // namespace

DataSetInfo Inspect(const model::TrialFile& file, const sim::TaskSpec* spec) {
  DataSetInfo info;
  info.summary = model::Summarize(file);
  const ActionTable table(spec);
  if (table.KnowsRetries()) info.retries = 0;
  std::map<int, Segments> of_action;
  for (std::size_t i = 0; i < file.size(); ++i) {
    const model::Trial trial = file.ReadLabels(i);
    AddSegments(trial, &of_action);
    if (table.HasRetry(trial)) ++info.retries;
  }
  for (const auto& [action, segments] : of_action) {
    info.actions.push_back(Measure(table.Name(action), segments));
  }
  return info;
}

void PrintInfo(const DataSetInfo& info, std::FILE* out) {
  const model::DataSetSummary& s = info.summary;
  std::fprintf(out, "task         %s (%s)\n", s.task.c_str(), s.world_version.c_str());
  if (!s.shard.empty()) {
    const Part part = PartFrom(s.shard, "the file");
    std::fprintf(out, "part         %d of %d; ./prospect merge joins all\n", part.index,
                 part.count);
  }
  std::fprintf(out, "trials       %zu: %zu train, %zu valid, %zu test\n", s.trials, s.train,
               s.valid, s.test);
  std::fprintf(out, "frames       %zu of %dx%d\n", s.frames, s.width, s.height);
  std::fprintf(out, "successes    %zu (%.1f %%)\n", s.successes, Percent(s.successes, s.trials));
  PrintCauses(Reasons(s), static_cast<int>(s.trials), out);
  if (info.retries >= 0) {
    std::fprintf(out, "try again    %d trials (%.1f %%)\n", info.retries,
                 Percent(static_cast<std::size_t>(info.retries), s.trials));
  }
  std::fprintf(out, "actions      %zu carried out, %zu succeeded\n", s.segments,
               s.segments_succeeded);
  std::fprintf(out, "  %-24s %7s %10s   seconds: %5s %8s %6s\n", "action", "count", "succeeded",
               "5 %", "median", "95 %");
  for (const SegmentLengths& a : info.actions) {
    std::fprintf(out, "  %-24s %7d %8.1f %% %15.1f %8.1f %6.1f\n", a.action.c_str(), a.count,
                 100.0 * a.succeeded / a.count, a.low, a.median, a.high);
  }
}

json InfoJson(const DataSetInfo& info) {
  const model::DataSetSummary& s = info.summary;
  const std::map<std::string, int> reasons = Reasons(s);
  json actions = json::array();
  for (const SegmentLengths& a : info.actions) {
    actions.push_back({{"action", a.action},
                       {"count", a.count},
                       {"succeeded", a.succeeded},
                       {"seconds_p05", a.low},
                       {"seconds_p50", a.median},
                       {"seconds_p95", a.high}});
  }
  return {{"task", s.task},
          {"world_version", s.world_version},
          {"part", s.shard.empty() ? json() : ToJson(PartFrom(s.shard, "the file"))},
          {"trials", s.trials},
          {"successes", s.successes},
          {"failures", ByCause(reasons)},
          {"reasons", reasons},
          {"retries", info.retries < 0 ? json(nullptr) : json(info.retries)},
          {"frames", s.frames},
          {"segments", s.segments},
          {"segments_succeeded", s.segments_succeeded},
          {"train", s.train},
          {"valid", s.valid},
          {"test", s.test},
          {"width", s.width},
          {"height", s.height},
          {"num_actions", s.num_actions},
          {"actions", actions}};
}

}  // namespace prospect::tools

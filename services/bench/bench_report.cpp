#include "services/bench/bench_report.h"

#include <cmath>
#include <cstdio>
#include <sstream>

#include "base/atomic_file.h"

namespace prospect::services {
namespace {

using nlohmann::json;

template <class F>
double Sum(const std::vector<SearchRun>& runs, F field) {
  double sum = 0;
  for (const SearchRun& run : runs) sum += static_cast<double>(field(run));
  return sum;
}

double Ratio(double a, double b) { return b > 0 ? a / b : 0; }

void AddLatency(const std::vector<SearchRun>& runs, json* row) {
  const auto n = static_cast<double>(runs.size());
  (*row)["latency_ms_p50"] = Ratio(Sum(runs, [](auto& r) { return r.latency_p50; }), n);
  (*row)["latency_ms_p90"] = Ratio(Sum(runs, [](auto& r) { return r.latency_p90; }), n);
  (*row)["latency_ms_p99"] = Ratio(Sum(runs, [](auto& r) { return r.latency_p99; }), n);
}

void AddDecisions(const std::vector<SearchRun>& runs, json* row) {
  const auto n = static_cast<double>(runs.size());
  const double optimal = Sum(runs, [](auto& r) { return r.optimal ? 1 : 0; });
  (*row)["optimal_count"] = optimal;
  (*row)["optimal_rate"] = Ratio(optimal, n);
  (*row)["regret"] = Ratio(Sum(runs, [](auto& r) { return r.optimum - r.score; }), n);
  (*row)["converged_share"] = Ratio(Sum(runs, [](auto& r) { return r.converged ? 1 : 0; }), n);
}

void AddCosts(const std::vector<SearchRun>& runs, json* row) {
  const double rollouts = Sum(runs, [](auto& r) { return r.rollouts; });
  const double seconds = Sum(runs, [](auto& r) { return r.seconds; });
  const double statistics = Sum(runs, [](auto& r) { return r.statistics_bytes; });
  const double asked = Sum(runs, [](auto& r) { return r.request_bytes + r.reply_bytes; });
  const double requests = Sum(runs, [](auto& r) { return r.requests; });
  (*row)["statistics_bytes_per_rollout"] = Ratio(statistics, rollouts);
  (*row)["bytes_per_rollout"] = Ratio(statistics + asked, rollouts);
  (*row)["cpu_cores"] =
      Ratio(Sum(runs, [](auto& r) { return r.server_cpu + r.worker_cpu; }), seconds);
  (*row)["resent_share"] = Ratio(Sum(runs, [](auto& r) { return r.resent; }), requests);
}

}  // namespace

json RowOf(int workers, const std::vector<SearchRun>& runs,
           const cli::BenchSearchOptions& options) {
  const double rollouts = Sum(runs, [](auto& r) { return r.rollouts; });
  const double evaluations = Sum(runs, [](auto& r) { return r.evaluations; });
  const double seconds = Sum(runs, [](auto& r) { return r.seconds; });
  const double batches = Sum(runs, [](auto& r) { return r.batches; });
  json row = {{"workers", workers}, {"runs", runs.size()}};
  row["rollouts_per_s"] = Ratio(rollouts, seconds);
  row["evaluations_per_s"] = Ratio(evaluations, seconds);
  row["evaluations_per_rollout"] = Ratio(evaluations, rollouts);
  row["requested_per_rollout"] = Ratio(Sum(runs, [](auto& r) { return r.requested; }), rollouts);
  row["mean_batch"] = Ratio(evaluations, batches);
  row["batch_share"] = Ratio(evaluations, batches * options.max_batch);
  row["compute_share"] =
      Ratio(Sum(runs, [](auto& r) { return r.batch_seconds; }), seconds * options.servers);
  row["overshoot"] =
      Ratio(rollouts, static_cast<double>(runs.size())) - static_cast<double>(options.samples);
  row["compute_ms"] = 1000 * Ratio(Sum(runs, [](auto& r) { return r.batch_seconds; }), batches);
  AddDecisions(runs, &row);
  AddCosts(runs, &row);
  AddLatency(runs, &row);
  row["overhead_ms_p50"] = row["latency_ms_p50"].get<double>() - row["compute_ms"].get<double>();
  return row;
}

void AddSpeedup(const std::vector<SearchRun>& first, const std::vector<SearchRun>& runs,
                json* row) {
  double sum = 0, squares = 0;
  const auto n = static_cast<double>(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double rate = Ratio(static_cast<double>(runs[i].rollouts), runs[i].seconds);
    const double base = Ratio(static_cast<double>(first[i].rollouts), first[i].seconds);
    sum += Ratio(rate, base);
    squares += Ratio(rate, base) * Ratio(rate, base);
  }
  const double mean = sum / n;
  const double variance = n > 1 ? std::max(0.0, (squares - n * mean * mean) / (n - 1)) : 0;
  const double half = 1.96 * std::sqrt(variance / n);
  (*row)["speedup"] = mean;
  (*row)["speedup_low"] = mean - half;
  (*row)["speedup_high"] = mean + half;
}

std::string TableHead() {
  return "workers leaves  rollouts/s   growth (95 %)        evals/s  mean batch  computing  "
         "optimal  "
         "regret  stat B/rollout  B/rollout   cores  latency ms p50    p90    p99\n";
}

std::string TableLine(const json& row) {
  const auto at = [&](const char* key) { return row.at(key).get<double>(); };
  char line[256];
  std::snprintf(
      line, sizeof line,
      "%7.0f %6.0f %11.1f %6.2f (%5.2f..%5.2f) %10.1f %11.2f %10.2f %8.2f %7.4f %15.1f %10.0f "
      "%7.2f %15.2f %6.2f %6.2f\n",
      at("workers"), at("leaves"), at("rollouts_per_s"), at("speedup"), at("speedup_low"),
      at("speedup_high"), at("evaluations_per_s"), at("mean_batch"), at("compute_share"),
      at("optimal_rate"), at("regret"), at("statistics_bytes_per_rollout"), at("bytes_per_rollout"),
      at("cpu_cores"), at("latency_ms_p50"), at("latency_ms_p90"), at("latency_ms_p99"));
  return line;
}

void WriteCsv(const std::string& path, const json& rows) {
  std::ostringstream file;
  const char* comma = "";
  for (const auto& [key, value] : rows.at(0).items()) file << comma << key, comma = ",";
  for (const auto& row : rows) {
    file << '\n';
    comma = "";
    for (const auto& [key, value] : row.items()) file << comma << value, comma = ",";
  }
  file << '\n';
  base::WriteFile(path, file.str());
}

}  // namespace prospect::services

#include "tools/bench/simulated_arms.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <functional>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace prospect::tools {
namespace {

using nlohmann::json;
using Results = std::vector<BusResult>;
using Figure = std::function<double(const BusResult&)>;

constexpr int kResamples = 1000;

std::int64_t Milliseconds(const std::string& text) {
  return static_cast<std::int64_t>(1000 * std::stod(text));
}

void Set(const std::string& key, const std::string& value, BusOptions* options) {
  using Setter = std::function<void()>;
  BusOptions& o = *options;
  const std::map<std::string, Setter> setters = {
      {"workers", [&] { o.workers = std::stoi(value); }},
      {"leaves", [&] { o.leaves = std::stoi(value); }},
      {"samples", [&] { o.parameters.samples = std::stoll(value); }},
      {"sharing", [&] { o.parameters.sharing = std::stoi(value) != 0; }},
      {"rule", [&] { o.parameters.rule = value; }},
      {"c", [&] { o.parameters.c = std::stod(value); }},
      {"c_puct", [&] { o.parameters.c_puct = std::stod(value); }},
      {"drop", [&] { o.drop = std::stod(value); }},
      {"repeat", [&] { o.repeat = std::stod(value); }},
      {"delay", [&] { o.delay_us = Milliseconds(value); }},
      {"jitter", [&] { o.jitter_us = Milliseconds(value); }},
      {"fixed", [&] { o.fixed_us = Milliseconds(value); }},
      {"row", [&] { o.row_us = Milliseconds(value); }},
      {"tick", [&] { o.tick_us = Milliseconds(value); }},
  };
  const auto found = setters.find(key);
  if (found == setters.end()) throw std::invalid_argument("an arm has no '" + key + "'");
  try {
    found->second();
  } catch (const std::exception&) {
    throw std::invalid_argument("an arm's " + key + " cannot be '" + value + "'");
  }
}

// Where a sum over seeds lies: 95 % of what resampled sets of seeds give.
json Interval(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return json::array({at(0.025), at(0.975)});
}

// For each resampled set of seeds, the mean of a figure.
std::vector<double> Resampled(const Results& results, const Figure& figure) {
  std::mt19937 random(1);  // the same sets for every arm: pairs stay together
  std::uniform_int_distribution<std::size_t> any(0, results.size() - 1);
  std::vector<double> values;
  for (const BusResult& result : results) values.push_back(figure(result));
  std::vector<double> means;
  for (int i = 0; i < kResamples; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k) sum += values[any(random)];
    means.push_back(sum / static_cast<double>(values.size()));
  }
  return means;
}

double Mean(const Results& results, const Figure& figure) {
  double sum = 0;
  for (const BusResult& result : results) sum += figure(result);
  return sum / static_cast<double>(results.size());
}

double Optimal(const BusResult& result) { return result.optimal ? 1 : 0; }
double Regret(const BusResult& result) { return result.regret; }

json RatioToFirst(const Results& arm, const Results& first, const Figure& figure) {
  const double base = Mean(first, figure);
  if (base <= 0) return nullptr;
  std::vector<double> ratios = Resampled(arm, figure);
  const std::vector<double> bases = Resampled(first, figure);
  for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i] /= std::max(bases[i], 1e-12);
  return {{"ratio", Mean(arm, figure) / base}, {"interval", Interval(ratios)}};
}

json RowOf(const Arm& arm, const Results& results, const Results& first) {
  const auto total = [&](const Figure& figure) {
    return Mean(results, figure) * static_cast<double>(results.size());
  };
  const double rollouts = total([](const BusResult& r) { return static_cast<double>(r.rollouts); });
  const double evaluations =
      total([](const BusResult& r) { return static_cast<double>(r.evaluations); });
  const double batches = total([](const BusResult& r) { return static_cast<double>(r.batches); });
  const double seconds =
      1e-6 * total([](const BusResult& r) { return static_cast<double>(r.simulated_us); });
  const auto most = std::max_element(results.begin(), results.end(),
                                     [](auto& a, auto& b) { return a.rollouts < b.rollouts; });
  return {
      {"arm", arm.name},
      {"workers", arm.options.workers},
      {"samples", arm.options.parameters.samples},
      {"rollouts", rollouts / static_cast<double>(results.size())},
      {"most_rollouts", most->rollouts},
      {"rollouts_per_s", rollouts / seconds},
      {"evaluations_per_s", evaluations / seconds},
      {"mean_batch", evaluations / batches},
      {"optimal_rate", Mean(results, Optimal)},
      {"optimal_rate_interval", Interval(Resampled(results, Optimal))},
      {"regret", Mean(results, Regret)},
      {"regret_interval", Interval(Resampled(results, Regret))},
      {"optimal_rate_against_first", RatioToFirst(results, first, Optimal)},
      {"regret_against_first", RatioToFirst(results, first, Regret)},
      {"exact_rate", Mean(results, [](const BusResult& r) { return r.exact ? 1.0 : 0.0; })},
      {"bytes_per_rollout",
       total([](const BusResult& r) { return r.statistics_bytes; }) / rollouts},
      {"statistics_us_per_rollout",
       total([](const BusResult& r) { return r.statistics_us; }) / rollouts},
      {"fresh", Mean(results, [](const BusResult& r) { return r.fresh; })},
      {"server_busy", Mean(results, [](const BusResult& r) { return r.server_busy; })},
      {"worker_busy", Mean(results, [](const BusResult& r) { return r.worker_busy; })},
      {"bus_busy", Mean(results, [](const BusResult& r) { return r.bus_busy; })},
      {"bottleneck", results.front().Bottleneck()},
  };
}

Results RunArm(const Arm& arm, int first_seed, int seeds, int threads) {
  Results results(seeds);
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < seeds; i = next++) {
      BusOptions options = arm.options;
      options.seed = static_cast<std::uint64_t>(first_seed + i);
      results[i] = SimulateBus(options);
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  return results;
}

std::string Ratio(const json& ratio) {
  if (ratio.is_null()) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.3f (%.3f-%.3f)", ratio["ratio"].get<double>(),
                ratio["interval"][0].get<double>(), ratio["interval"][1].get<double>());
  return text;
}

}  // namespace

Arm ParseArm(const std::string& text, const BusOptions& defaults) {
  Arm arm{text, defaults};
  std::stringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos) {
      throw std::invalid_argument("'" + part + "': write an arm as workers=8,drop=0.3");
    }
    Set(part.substr(0, equals), part.substr(equals + 1), &arm.options);
  }
  arm.options.parameters.Validate();
  return arm;
}

json RunArms(const std::vector<Arm>& arms, int first_seed, int seeds, int threads) {
  json rows = json::array();
  Results first;
  for (const Arm& arm : arms) {
    const Results results = RunArm(arm, first_seed, seeds, threads);
    if (first.empty()) first = results;
    rows.push_back(RowOf(arm, results, first));
  }
  return rows;
}

void PrintArms(const json& rows) {
  std::printf("%-36s %8s %10s %9s %6s %7s %8s %21s %21s %6s %7s %6s %6s %s\n", "arm", "rollouts",
              "rollouts/s", "evals/s", "batch", "optimal", "regret", "optimal to the first",
              "regret to the first", "B/roll", "us/roll", "fresh", "exact", "bottleneck");
  for (const json& row : rows) {
    std::printf("%-36s %8.1f %10.1f %9.1f %6.2f %7.3f %8.5f %21s %21s %6.1f %7.1f %6.3f %6.3f %s\n",
                row["arm"].get<std::string>().c_str(), row["rollouts"].get<double>(),
                row["rollouts_per_s"].get<double>(), row["evaluations_per_s"].get<double>(),
                row["mean_batch"].get<double>(), row["optimal_rate"].get<double>(),
                row["regret"].get<double>(), Ratio(row["optimal_rate_against_first"]).c_str(),
                Ratio(row["regret_against_first"]).c_str(), row["bytes_per_rollout"].get<double>(),
                row["statistics_us_per_rollout"].get<double>(), row["fresh"].get<double>(),
                row["exact_rate"].get<double>(), row["bottleneck"].get<std::string>().c_str());
  }
}

std::string ArmsAsCsv(const json& rows) {
  const std::vector<const char*> columns = {"arm",
                                            "workers",
                                            "samples",
                                            "rollouts",
                                            "rollouts_per_s",
                                            "evaluations_per_s",
                                            "mean_batch",
                                            "optimal_rate",
                                            "regret",
                                            "bytes_per_rollout",
                                            "statistics_us_per_rollout",
                                            "fresh",
                                            "exact_rate",
                                            "server_busy",
                                            "worker_busy",
                                            "bus_busy",
                                            "bottleneck"};
  std::string text;
  for (const char* column : columns) text += (text.empty() ? "" : ",") + std::string(column);
  for (const json& row : rows) {
    text += '\n';
    for (const char* column : columns) {
      text += (column == columns.front() ? "" : ",") + row[column].dump();
    }
  }
  return text + '\n';
}

}  // namespace prospect::tools

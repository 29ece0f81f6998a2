// deaths_bench [REPEATS]: how a search fares when processes are killed in the middle of it. Prints
// one line a repeat and fault, and at the end the median. Run by tests/benchmarks/deaths.sh.

#include <signal.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "services/binding/request_window.h"
#include "services/common/clock.h"
#include "tests/faults/watched_search.h"

namespace {

using namespace prospect::tests;
using prospect::services::SteadyMs;

constexpr int kBudgetMs = 7000;

void Require(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(what);
}

struct WorkerDeath {
  double ratio;               // rollouts/s from 1 to 2.5 s after the kill over those before
  std::int64_t forgotten_ms;  // until its visits in flight no longer counted
};

WorkerDeath KillOneOfFourWorkers() {
  WatchedSearch search("bench_worker");
  search.Server();
  Process& victim = search.Worker();
  for (int i = 0; i < 3; ++i) search.Worker();
  Require(search.Up(1, 4), "the services did not come up");
  const std::int64_t dead = search.IdOf("worker", victim.pid());
  search.Begin(4, kBudgetMs);
  Require(search.UnderWay(), "no rollouts");
  search.witness.Listen(1500);
  victim.Signal(SIGKILL);
  const std::int64_t killed_ms = SteadyMs();
  Require(search.witness.Until([&] { return !search.observer.View(dead)->live; }, 5000),
          "the dead worker counts for ever");
  const std::int64_t forgotten_ms = SteadyMs() - killed_ms;
  search.witness.Until([&] { return SteadyMs() >= killed_ms + 2500; }, 5000);
  const double before = search.observer.RolloutRate(killed_ms - 1500, killed_ms);
  const double after = search.observer.RolloutRate(killed_ms + 1000, killed_ms + 2500);
  search.End();
  return {after / before, forgotten_ms};
}

// Milliseconds from a new server's first sign of life to its first evaluation.
std::int64_t ReplaceTheOnlyServer() {
  WatchedSearch search("bench_server");
  Process& first = search.Server();
  for (int i = 0; i < 2; ++i) search.Worker();
  Require(search.Up(1, 2), "the services did not come up");
  search.Begin(2, kBudgetMs);
  Require(search.UnderWay(), "no rollouts");
  first.Signal(SIGKILL);
  Process& second = search.Server();
  Require(search.witness.Until([&] { return search.IdOf("model", second.pid()) != 0; }, 10000),
          "the new server did not come up");
  const std::int64_t up_ms = SteadyMs();
  const std::int64_t id = search.IdOf("model", second.pid());
  Require(search.witness.Until([&] { return search.observer.FirstReplyMs(id) != 0; }, 5000),
          "the new server was not asked");
  search.End();
  return search.observer.FirstReplyMs(id) - up_ms;
}

// The longest time, milliseconds, that any worker completed no rollout after one of two servers was
// killed.
std::int64_t KillOneOfTwoServers() {
  WatchedSearch search("bench_servers");
  Process& victim = search.Server();
  search.Server();
  std::vector<int> pids;
  for (int i = 0; i < 2; ++i) pids.push_back(search.Worker().pid());
  Require(search.Up(2, 2), "the services did not come up");
  search.Begin(2, kBudgetMs);
  Require(search.UnderWay(), "no rollouts");
  victim.Signal(SIGKILL);
  const std::int64_t killed_ms = SteadyMs();
  search.witness.Listen(3500);
  std::int64_t stall = 0;
  for (const int pid : pids) {
    const std::int64_t id = search.IdOf("worker", pid);
    stall = std::max(stall, search.observer.LongestStallMs(id, killed_ms, killed_ms + 3500));
  }
  search.End();
  return stall;
}

template <class T>
T Median(std::vector<T> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void Measure(int repeats) {
  std::vector<double> ratios;
  std::vector<std::int64_t> forgotten, resumed, stalls;
  for (int i = 0; i < repeats; ++i) {
    const WorkerDeath death = KillOneOfFourWorkers();
    ratios.push_back(death.ratio);
    forgotten.push_back(death.forgotten_ms);
    resumed.push_back(ReplaceTheOnlyServer());
    stalls.push_back(KillOneOfTwoServers());
    std::printf(
        "%d: rollouts/s after over before %.2f, in flight forgotten after %ld ms, new "
        "server's first evaluation after %ld ms, longest stall with two servers %ld ms\n",
        i + 1, ratios.back(), static_cast<long>(forgotten.back()),
        static_cast<long>(resumed.back()), static_cast<long>(stalls.back()));
    std::fflush(stdout);
  }
  std::printf("median: %.2f (bar 0.70), %ld ms (bar %d), %ld ms (bar 1000), %ld ms (bar %ld)\n",
              Median(ratios), static_cast<long>(Median(forgotten)),
              2 * prospect::services::kLeaseMs, static_cast<long>(Median(resumed)),
              static_cast<long>(Median(stalls)),
              static_cast<long>(prospect::services::RequestWindow::kLongestTimeoutMs));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Measure(argc > 1 ? std::max(1, std::atoi(argv[1])) : 5);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  return 0;
}

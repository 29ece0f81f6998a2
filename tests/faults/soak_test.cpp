// Search after search with a bad network everywhere: nothing grows. PROSPECT_SOAK_SECONDS says how
// long (60); tests/benchmarks/soak.sh runs 20 minutes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <list>
#include <string>

#include "services/common/clock.h"
#include "tests/faults/counts.h"
#include "tests/faults/gauge.h"
#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

using services::SteadyMs;

constexpr int kWorkers = 3;
constexpr int kServers = 2;
constexpr std::int64_t kSampleMs = 250;
// Growth from the middle third to the last that counts as flat: allocators settle late.
constexpr std::int64_t kFlatKb = 1024;
constexpr double kFlatShare = 0.02;
// Every so many searches one is acted on, with the simulator's physics; the others are refused.
constexpr int kActEvery = 6;

int SoakSeconds() {
  const char* wanted = std::getenv("PROSPECT_SOAK_SECONDS");
  return wanted ? std::max(10, std::atoi(wanted)) : 60;
}

std::vector<std::string> With(std::vector<std::string> arguments, int seed) {
  arguments.insert(arguments.end(),
                   {"--chaos", "drop=0.1,dup=0.05,reorder=0.05,corrupt=0.01,delay=2ms,seed=" +
                                   std::to_string(seed)});
  return arguments;
}

class Soak {
 public:
  Soak() : deployment_("soak") {
    const std::vector<std::string> server{"--fixed-cost", "10,0"};
    Watch("simulator", deployment_.Simulator(With({}, 1)));
    for (int i = 0; i < kServers; ++i)
      Watch("server " + std::to_string(i + 1), deployment_.ModelServer(With(server, 2 + i)));
    for (int i = 0; i < kWorkers; ++i)
      Watch("worker " + std::to_string(i + 1), deployment_.Worker(With({}, 4 + i)));
  }

  bool Up() {
    return witness_.Until(
        [&] {
          return witness_.Ready("simulator", 1) && witness_.Ready("model", kServers) &&
                 witness_.Ready("worker", kWorkers);
        },
        20000);
  }

  // One executive from start to end.
  void Search() {
    const bool act = ++searches_ % kActEvery == 0;
    auto& executive = deployment_.Executive(
        With({"--workers", std::to_string(kWorkers), "--refusal-threshold", act ? "0" : "1"},
             100 + searches_),
        1500000 + searches_ % 50);
    int code = -1;
    ASSERT_TRUE(witness_.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000,
                               [&] { SampleWhenDue(); }));
    EXPECT_TRUE(act ? code == 0 || code == 4 : code == 3) << code << " in " << deployment_.folder;
    deployment_.Forget(executive);
    witness_.statuses.clear();
    witness_.replies.clear();
    witness_.roots.clear();
  }

  void Report() const {
    std::printf("%d searches in %d s\n%-12s %10s %10s %8s %8s\n", searches_, SoakSeconds(),
                "process", "kB middle", "kB last", "files", "held");
    for (const Gauge& gauge : gauges_)
      std::printf("%-12s %10ld %10ld %8ld %8ld\n", gauge.name().c_str(), Kb(gauge, 1), Kb(gauge, 2),
                  static_cast<long>(gauge.Files(2.0 / 3, 1)),
                  static_cast<long>(gauge.Held(2.0 / 3, 1)));
  }

  void CheckFlat() const {
    for (const Gauge& gauge : gauges_) {
      ASSERT_GE(gauge.samples(), 9u) << gauge.name() << " ended";
      const long middle = Kb(gauge, 1);
      EXPECT_LE(Kb(gauge, 2) - middle, kFlatKb + static_cast<long>(kFlatShare * middle))
          << gauge.name() << " grows, kB";
      EXPECT_LE(gauge.Files(2.0 / 3, 1), gauge.Files(1.0 / 3, 2.0 / 3)) << gauge.name();
      EXPECT_LE(gauge.Held(2.0 / 3, 1), 2 * gauge.Held(1.0 / 3, 2.0 / 3) + 100) << gauge.name();
    }
  }

 private:
  void Watch(const std::string& name, Process& process) {
    gauges_.emplace_back(name, process.pid());
  }

  // Entries in the caches of a process, by the counters "held ..." of its HEALTH.
  std::int64_t HeldBy(int pid) const {
    std::int64_t held = 0;
    for (const auto& [id, health] : witness_.health) {
      if (health.pid != pid) continue;
      for (const auto& counter : health.counters)
        if (counter.name.rfind("held ", 0) == 0) held += counter.value;
    }
    return held;
  }

  void SampleWhenDue() {
    if (!due_.Due(SteadyMs())) return;
    for (Gauge& gauge : gauges_) gauge.Sample(HeldBy(gauge.pid()));
  }

  // Resident memory in the given third of the time, counted from 0.
  static long Kb(const Gauge& gauge, int third) {
    return static_cast<long>(gauge.ResidentKb(third / 3.0, (third + 1) / 3.0));
  }

  Witness witness_;
  Deployment deployment_;
  std::list<Gauge> gauges_;
  services::Periodic due_{kSampleMs};
  int searches_ = 0;
};

TEST(Soak, NothingGrows) {
  Soak soak;
  ASSERT_TRUE(soak.Up());
  const std::int64_t end_ms = SteadyMs() + 1000LL * SoakSeconds();
  while (SteadyMs() < end_ms && !testing::Test::HasFailure()) soak.Search();
  soak.Report();
  soak.CheckFlat();
}

}  // namespace
}  // namespace prospect::tests

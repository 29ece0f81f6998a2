// Real programs, every one with a bad network at its ears: where digests agree, counts are exact,
// and nothing that was changed on the way is believed.

#include <gtest/gtest.h>

#include <string>

#include "tests/faults/counts.h"
#include "tests/faults/search_observer.h"
#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

constexpr int kWorkers = 3;
constexpr int kSearches = 3;

std::vector<std::string> Chaos(int seed) {
  return {"--chaos",
          "drop=0.2,dup=0.1,reorder=0.2,corrupt=0.05,delay=3ms,seed=" + std::to_string(seed)};
}

TEST(Exactness, CountsAreExactWhereDigestsAgree) {
  Witness witness;
  SearchObserver observer(witness.bus);
  Deployment deployment("exactness");
  deployment.Simulator(Chaos(1));
  deployment.ModelServer(Chaos(2));
  for (int i = 0; i < kWorkers; ++i) deployment.Worker(Chaos(3 + i));
  ASSERT_TRUE(witness.Until(
      [&] {
        return witness.Ready("simulator", 1) && witness.Ready("model", 1) &&
               witness.Ready("worker", kWorkers);
      },
      20000));
  int agreed = 0;
  for (int i = 0; i < kSearches; ++i) {
    const std::int64_t before = RolloutsTold(witness);
    auto arguments = Chaos(10 + i);
    arguments.insert(arguments.end(),
                     {"--workers", std::to_string(kWorkers), "--refusal-threshold", "1"});
    auto& executive = deployment.Executive(arguments);
    int code = -1;
    ASSERT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000));
    ASSERT_EQ(code, 3) << deployment.folder;
    const auto search = deployment.Result().at("searches").at(0);
    // The next signs of life are whole: no rollout is made between searches.
    witness.Listen(1200);
    if (!search.at("converged").get<bool>()) continue;
    ++agreed;
    EXPECT_EQ(search.at("rollouts"), RolloutsTold(witness) - before);
    EXPECT_EQ(search.at("rollouts"), observer.rollouts());
    EXPECT_LE(search.at("evaluations").get<std::size_t>(), observer.evaluated());
  }
  EXPECT_GT(agreed, 0) << "digests never agreed";
  std::int64_t refused = 0;
  for (const auto& worker : witness.Services("worker")) refused += worker.refused;
  EXPECT_GT(refused, 0) << "nothing was corrupted";
}

}  // namespace
}  // namespace prospect::tests

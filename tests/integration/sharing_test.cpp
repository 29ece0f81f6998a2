// Two workers really share one tree: fewer evaluations for the same rollouts, and one answer.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/integration/support/deployment.h"

namespace prospect::tests {
namespace {

struct Counts {
  std::int64_t rollouts = 0;
  std::int64_t requested = 0;  // evaluations, summed over workers
  std::int64_t distinct = 0;   // paths evaluated
};

Counts FirstSearch(Witness& witness, const std::string& name,
                   const std::vector<std::string>& more) {
  Deployment deployment(name);
  EXPECT_TRUE(deployment.Up(witness, 2));
  std::vector<std::string> arguments{"--workers", "2", "--refusal-threshold", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  auto& executive = deployment.Executive(arguments);
  int code = -1;
  EXPECT_TRUE(witness.Until([&] { return (code = executive.Wait(0)) >= 0; }, 60000));
  EXPECT_EQ(code, 3);
  const auto search = deployment.Result().at("searches").at(0);
  return {search.at("rollouts"), search.at("evaluations_requested"), search.at("evaluations")};
}

TEST(Sharing, FewerEvaluationsForTheSameRollouts) {
  Witness witness;
  const Counts together = FirstSearch(witness, "together", {});
  const Counts apart = FirstSearch(witness, "apart", {"--no-sharing"});
  for (const Counts& counts : {together, apart}) {
    EXPECT_GE(counts.rollouts, 150);
    EXPECT_LE(counts.rollouts, 150 + 2 * 2) << "overshot by more than workers times leaves";
  }
  // Together, nearly every evaluation is asked for once; apart, what both trees hold is asked for
  // twice.
  EXPECT_LE(together.requested, together.distinct + together.distinct / 3);
  EXPECT_GE(apart.requested, apart.distinct + apart.distinct / 4);
  EXPECT_GT(apart.requested * together.distinct, together.requested * apart.distinct);
}

// After the closing round each worker notes on HEALTH what it would do.
TEST(Sharing, EveryWorkerReadsOffTheSamePlan) {
  Witness witness;
  Deployment deployment("same_plan");
  ASSERT_TRUE(deployment.Up(witness, 3));
  auto& executive = deployment.Executive({"--workers", "3", "--refusal-threshold", "0"});
  ASSERT_TRUE(witness.Until([&] { return executive.Wait(0) >= 0; }, 60000));
  const auto notes = [&] {
    std::set<std::string> found;
    for (const auto& worker : witness.Services("worker")) found.insert(worker.message);
    return found;
  };
  const std::string search = std::to_string(witness.roots.back().search_id);
  const auto agreed = [&] {
    return notes().size() == 1 && notes().begin()->find(search) != std::string::npos;
  };
  ASSERT_TRUE(witness.Until(agreed, 5000)) << *notes().begin() << " | " << *notes().rbegin();
  EXPECT_NE(notes().begin()->find("plan "), std::string::npos) << *notes().begin();
  EXPECT_EQ(witness.finals.size(), 3u);

  ASSERT_FALSE(witness.plans.empty());
  std::string steps;
  for (const auto& step : witness.plans.back().steps) {
    steps += (steps.empty() ? "" : ", ") + step.name;
  }
  EXPECT_NE(notes().begin()->find("plan " + steps + ";"), std::string::npos)
      << steps << " | " << *notes().begin();
}

}  // namespace
}  // namespace prospect::tests

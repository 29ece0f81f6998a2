#include "model/training/time_budget.h"

#include <gtest/gtest.h>

#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

const std::map<std::string, double> kShares = {{"encoder", 1}, {"heads", 3}};

double Never() {
  ADD_FAILURE() << "the speed was measured before";
  return 1;
}

TEST(TimeBudget, GivesAStageWhatFitsIntoItsShare) {
  const TestFolder folder;
  TimeBudget budget(folder / "minutes.json", 2, "key", kShares);
  EXPECT_EQ(budget.Iterations("encoder", [] { return 0.1; }), 300);  // a quarter of 120 s
  EXPECT_EQ(budget.Iterations("heads", [] { return 0.5; }), 180);
  EXPECT_EQ(budget.Iterations("encoder", Never), 300);
}

TEST(TimeBudget, ARunThatGoesOnTrainsWhatItBegan) {
  const TestFolder folder;
  const std::string path = folder / "minutes.json";
  TimeBudget(path, 2, "key", kShares).Iterations("encoder", [] { return 0.1; });
  EXPECT_EQ(TimeBudget(path, 2, "key", kShares).Iterations("encoder", Never), 300);
}

TEST(TimeBudget, AnotherTimeOrConfigurationIsMeasuredAnew) {
  const TestFolder folder;
  const std::string path = folder / "minutes.json";
  TimeBudget(path, 2, "key", kShares).Iterations("encoder", [] { return 0.1; });
  EXPECT_EQ(TimeBudget(path, 4, "key", kShares).Iterations("encoder", [] { return 0.2; }), 300);
  EXPECT_EQ(TimeBudget(path, 4, "other", kShares).Iterations("encoder", [] { return 0.1; }), 600);
}

TEST(TimeBudget, AStageTooSlowForItsTimeGetsOne) {
  const TestFolder folder;
  TimeBudget budget(folder / "minutes.json", 0.01, "key", kShares);
  EXPECT_EQ(budget.Iterations("encoder", [] { return 100.0; }), 1);
}

}  // namespace
}  // namespace prospect::model

#include "tools/evaluate/simulator_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/rollout.h"
#include "sim/task_factory.h"
#include "tools/evaluate/decider.h"

namespace prospect::tools {
namespace {

TEST(SimulatorModel, LeavesTheTaskAsItWas) {
  const auto task = sim::MakeTask("navigation");
  const auto twin = sim::MakeTask("navigation");
  task->Reset(1234567);
  twin->Reset(1234567);
  SimulatorModel model(task.get(), 99, 1);
  const std::vector<int> legal = task->LegalActions();
  ASSERT_FALSE(legal.empty());
  for (int action : legal) model.Evaluate({static_cast<std::uint8_t>(action)});
  EXPECT_EQ(task->LegalActions(), legal);
  // The real run afterwards is the one that would have been without the model.
  sim::RunAction(*task, legal.front(), nullptr);
  sim::RunAction(*twin, legal.front(), nullptr);
  EXPECT_EQ(task->RobotState(), twin->RobotState());
}

TEST(SimulatorModel, PermitsWhatIsLegalAndJudgesByOutcome) {
  const auto task = sim::MakeTask("navigation");
  task->Reset(1234567);
  SimulatorModel model(task.get(), 99, 1);
  const planner::Evaluation root = model.Evaluate({});
  const std::vector<int> legal = task->LegalActions();
  for (std::size_t a = 0; a < root.p.size(); ++a) {
    const bool is_legal = std::count(legal.begin(), legal.end(), static_cast<int>(a)) > 0;
    EXPECT_EQ(root.p[a], is_legal ? 1.f : 0.f);
  }
  for (int action : legal) {
    const planner::Evaluation after = model.Evaluate({static_cast<std::uint8_t>(action)});
    EXPECT_EQ(after.value, after.done);
    EXPECT_EQ(after.done > 0, after.p != planner::Evaluation{}.p && !after.p.empty() &&
                                  *std::max_element(after.p.begin(), after.p.end()) > 0);
  }
}

// Of several runs f is the share that goes well: what one run happens to do is no certainty.
TEST(SimulatorModel, SaysHowManyOfItsRunsGoWell) {
  const auto task = sim::MakeTask("navigation");
  constexpr int kRuns = 4;
  bool doubtful = false;
  for (std::uint64_t seed = 1'000'000; seed < 1'000'040 && !doubtful; ++seed) {
    task->Reset(seed);
    SimulatorModel model(task.get(), 99, kRuns);
    for (const int action : task->LegalActions()) {
      const float done = model.Evaluate({static_cast<std::uint8_t>(action)}).done;
      EXPECT_EQ(done * kRuns, std::round(done * kRuns));
      doubtful |= done > 0 && done < 1;
    }
  }
  EXPECT_TRUE(doubtful);
}

}  // namespace
}  // namespace prospect::tools

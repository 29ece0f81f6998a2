#include <gtest/gtest.h>

#include "planner/baseline_plans.h"
#include "sim/task_factory.h"
#include "tools/evaluate/decider.h"
#include "tools/evaluate/episode.h"

namespace prospect::tools {
namespace {

constexpr std::uint64_t kScene = 1'400'000;  // a tuning scene: never in a reported figure

// Plans the first `length` legal actions and counts how often it is asked.
class Counting : public LocalMind {
 public:
  Counting(int length, int* asked) : length_(length), asked_(asked) {}
  void Enter(sim::Task& task, std::uint64_t) override { task_ = &task; }

 private:
  agent::SearchAnswer Find(const agent::SearchQuestion&) override {
    ++*asked_;
    const std::vector<int> legal = task_->LegalActions();
    agent::SearchAnswer answer;
    answer.plan = planner::PlanOf(planner::Path(legal.begin(), legal.begin() + length_), "no plan");
    return answer;
  }

  sim::Task* task_ = nullptr;
  int length_;
  int* asked_;
};

std::unique_ptr<Decider> OpenLoopOf(int length, int* asked) {
  auto decider = std::make_unique<Decider>();
  decider->mind = std::make_unique<Counting>(length, asked);
  decider->options.novelty = 0;
  return MakeOpenLoop(std::move(decider));
}

TEST(OpenLoop, ThePlanIsCarriedOutAsItIs) {
  const auto task = sim::MakeTask("navigation");
  task->Reset(kScene);
  const std::vector<int> legal = task->LegalActions();
  int asked = 0;
  const auto open = OpenLoopOf(3, &asked);
  for (int round = 1; round <= 2; ++round) {  // the second scene begins afresh
    const EpisodeRecord record = RunEpisode(*task, *open, kScene, 0.01);
    EXPECT_EQ(asked, round);
    ASSERT_FALSE(record.actions.empty());
    for (std::size_t i = 0; i < record.actions.size(); ++i)
      EXPECT_EQ(record.actions[i], legal[i]) << i;
    EXPECT_NE(record.ending, Ending::kRefused);
  }
}

TEST(OpenLoop, AnEpisodeThatGoesOnAfterThePlanIsStopped) {
  const auto task = sim::MakeTask("navigation");
  int stopped = 0;
  for (std::uint64_t seed = kScene; seed < kScene + 10; ++seed) {
    int asked = 0;
    const auto open = OpenLoopOf(1, &asked);
    const EpisodeRecord record = RunEpisode(*task, *open, seed, 0.01);
    EXPECT_EQ(record.actions.size(), 1u);
    EXPECT_EQ(asked, 1);
    if (record.ending != Ending::kStopped) continue;  // the one action failed
    EXPECT_NE(record.reason.find("not complete"), std::string::npos);
    ++stopped;
  }
  EXPECT_GT(stopped, 0);
}

TEST(OpenLoop, ARefusalStaysOne) {
  const auto task = sim::MakeTask("navigation");
  int asked = 0;
  const auto open = OpenLoopOf(0, &asked);
  const EpisodeRecord record = RunEpisode(*task, *open, kScene, 0.01);
  EXPECT_EQ(record.ending, Ending::kRefused);
  EXPECT_EQ(record.reason, "no plan");
}

// Without a whole plan there is nothing to carry out unseen: it is asked each time.
TEST(OpenLoop, WhoHasNoPlanIsAskedEachTime) {
  const auto task = sim::MakeTask("navigation");
  const auto plain = MakeRandom();
  const auto open = MakeOpenLoop(MakeRandom());
  const EpisodeRecord a = RunEpisode(*task, *plain, kScene, 0.01);
  const EpisodeRecord b = RunEpisode(*task, *open, kScene, 0.01);
  EXPECT_EQ(a.actions, b.actions);
  EXPECT_EQ(a.ending, b.ending);
}

}  // namespace
}  // namespace prospect::tools

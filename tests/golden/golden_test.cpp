// What a change must not change unnoticed: how each world moves and looks, what the bundled weights
// are, which tree a search grows. Each is one number. Where physics or looks are meant to change,
// world_version goes up with the new number; where the search does, figures are measured anew.
//
// Positions are rounded to 0.01 mm and pictures to block means, so that another processor's or
// compiler's last bits do not count (docs/architecture.md). The exact bits, which hold for one
// build on one machine, are printed beside them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/hash.h"
#include "planner/model_source.h"
#include "planner/scripted_model.h"
#include "planner/search.h"
#include "sim/task_factory.h"

namespace prospect {
namespace {

constexpr std::uint64_t kScene = 1'400'007;  // a tuning scene: in no figure
constexpr int kTicks = 300;

struct Golden {
  const char* task;
  const char* hash;
};
std::ostream& operator<<(std::ostream& out, const Golden& golden) { return out << golden.task; }

void Tell(const char* what, const char* task, std::uint64_t exact) {
  std::printf("exact bits of %s, %s: %s\n", what, task, base::HexText(exact).c_str());
}

class World : public testing::TestWithParam<Golden> {};

// Always the first action that is legal, for a while.
TEST_P(World, MovesAsBefore) {
  const auto task = sim::MakeTask(GetParam().task);
  task->Reset(kScene);
  std::uint64_t rounded = base::kHashStart, exact = base::kHashStart;
  for (int tick = 0; tick < kTicks; ++tick) {
    const std::vector<int> legal = task->LegalActions();
    if (task->progress().action_state != sim::ActionState::kRunning && !legal.empty()) {
      ASSERT_TRUE(task->StartAction(legal.front()));
    }
    task->Tick();
    for (const double value : task->RobotState()) {
      exact = base::HashBytes(&value, sizeof value, exact);
      rounded = base::HashText(std::to_string(std::llround(value * 1e5)) + ' ', rounded);
    }
    rounded = base::HashText(task->progress().reason, rounded);
  }
  Tell("motion", GetParam().task, exact);
  EXPECT_EQ(base::HexText(rounded), GetParam().hash);
}

INSTANTIATE_TEST_SUITE_P(Golden, World,
                         testing::Values(Golden{"navigation", "2cc04ba67e5ef2be"},
                                         Golden{"stacking", "eaee3eb5ed6973ec"},
                                         Golden{"suturing", "85835221c5988de0"}),
                         [](const auto& one) { return std::string(one.param.task); });

class Names : public testing::TestWithParam<Golden> {};

// What weights, data sets and caches know a task and its world by.
TEST_P(Names, AreAsBefore) {
  const auto task = sim::MakeTask(GetParam().task);
  EXPECT_EQ(base::HexText(task->spec().Hash()) + ' ' + task->spec().world_version, GetParam().hash);
}

INSTANTIATE_TEST_SUITE_P(
    Golden, Names,
    testing::Values(Golden{"navigation", "e9642b6b9bf35f26 navigation-77ce6bd30834d346"},
                    Golden{"stacking", "83810aab1fa7ee98 stacking-33f828b4f113a3de"},
                    Golden{"suturing", "5289b9a625eb651c suturing-7f01e03f545ba353"}),
    [](const auto& one) { return std::string(one.param.task); });

class Picture : public testing::TestWithParam<Golden> {};

// Means of blocks of 8 x 8 pixels, in steps of 4 of 255.
std::string Blocks(const sim::Image& image) {
  constexpr int kSide = 8, kStep = 4;
  std::string text;
  for (int y = 0; y + kSide <= image.height; y += kSide) {
    for (int x = 0; x + kSide <= image.width; x += kSide) {
      int sums[3] = {};
      for (int i = 0; i < kSide * kSide * 3; ++i) {
        const int row = y + i / (kSide * 3), column = x * 3 + i % (kSide * 3);
        sums[i % 3] += image.rgb[static_cast<std::size_t>(row) * image.width * 3 + column];
      }
      for (const int sum : sums) text += std::to_string(sum / (kSide * kSide * kStep)) + ' ';
    }
  }
  return text;
}

TEST_P(Picture, LooksAsBefore) {
  const auto task = sim::MakeTask(GetParam().task);
  task->Reset(kScene);
  const sim::Image image = task->Observe();
  Tell("the picture", GetParam().task, base::HashBytes(image.rgb.data(), image.rgb.size()));
  EXPECT_EQ(base::HexText(base::HashText(Blocks(image))), GetParam().hash);
}

INSTANTIATE_TEST_SUITE_P(Golden, Picture,
                         testing::Values(Golden{"navigation", "ba2e26f47908221e"},
                                         Golden{"stacking", "11c5f8b90ca6c183"},
                                         Golden{"suturing", "d7924f2f0096fb5b"}),
                         [](const auto& one) { return std::string(one.param.task); });

class Weights : public testing::TestWithParam<Golden> {};

// The number that MODEL_INFO says, that reports name and that recordings ask for.
TEST_P(Weights, AreThoseOfThePublishedFigures) {
  std::ifstream in(PROSPECT_ROOT "/model/weights/" + std::string(GetParam().task) + ".safetensors",
                   std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(base::HexText(base::HashText(bytes)), GetParam().hash);
}

INSTANTIATE_TEST_SUITE_P(Golden, Weights,
                         testing::Values(Golden{"navigation", "7848b875e6ed708f"},
                                         Golden{"stacking", "ffaccafc17b46f0a"},
                                         Golden{"suturing", "5a1129c2d772939b"}),
                         [](const auto& one) { return std::string(one.param.task); });

// The whole tree: each path's visits and values, and the plan, in exact bits.
TEST(Search, GrowsTheSameTree) {
  planner::ScriptedModel model({6, 3, 0.2, 0.1, 0.1});
  planner::SearchParameters parameters;
  parameters.samples = 400;
  planner::Search search(planner::AnyOrder(6, 4), parameters, {}, {{1, 1}, 1, 0, 1'000'000});
  RunSearch(&search, &model);
  std::uint64_t hash = base::HashText(base::HexText(search.statistics().digest()));
  hash = base::HashText(ToString(search.BestPlan()), hash);
  EXPECT_EQ(base::HexText(hash), "2d064fe964bc3717");
}

}  // namespace
}  // namespace prospect

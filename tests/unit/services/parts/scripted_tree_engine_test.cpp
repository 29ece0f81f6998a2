#include "services/model/scripted_tree_engine.h"

#include <gtest/gtest.h>

namespace prospect::services {
namespace {

TEST(ScriptedTreeEngineTest, GivesTheTreesNumbersForTheSeedInThePicture) {
  ScriptedTreeEngine engine;
  for (const std::uint64_t seed : {0ULL, 7ULL, 0xfedcba9876543210ULL}) {
    const auto picture = ScriptedTreeEngine::PictureOf(seed);
    const model::Hidden root = engine.Encode(picture);
    const planner::ScriptedTree tree{seed};
    EXPECT_EQ(engine.Evaluate(root, root, 8).value, tree.Evaluate({}).value);
    model::Hidden at = root;
    planner::Path path;
    for (const std::uint8_t action : {3, 3, 0, 7, 1, 5}) {
      path.push_back(action);
      const auto answer = engine.Expand({{root, at, action}}).front();
      const auto expected = tree.Evaluate(path);
      EXPECT_EQ(answer.value, expected.value) << planner::ToString(path);
      EXPECT_EQ(answer.done, expected.done);
      EXPECT_EQ(answer.q, expected.q);
      EXPECT_EQ(answer.p, expected.p);
      at = answer.h;
    }
    EXPECT_THROW(engine.Expand({{root, at, 0}}), std::invalid_argument);
  }
}

TEST(ScriptedTreeEngineTest, RefusesWhatIsNoState) {
  ScriptedTreeEngine engine;
  const std::vector<float> noise(static_cast<std::size_t>(engine.info().hidden_size), 99.5F);
  EXPECT_THROW(engine.Expand({{noise, noise, 0}}), std::invalid_argument);
}

}  // namespace
}  // namespace prospect::services

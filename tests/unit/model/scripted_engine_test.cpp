#include "model/scripted_engine.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/row_pool.h"

namespace prospect::model {
namespace {

Prediction Walk(ScriptedEngine* engine, const std::vector<int>& path) {
  const auto& info = engine->info();
  const std::vector<std::uint8_t> picture(
      static_cast<std::size_t>(info.image_width * info.image_height * 3));
  const Hidden root = engine->Encode(picture);
  Prediction at = engine->Evaluate(root, root, engine->info().num_actions);
  at.h = root;
  for (const int action : path) at = engine->Expand({{root, at.h, action}})[0];
  return at;
}

TEST(ScriptedEngine, AnswersAreAFunctionOfThePath) {
  ScriptedEngine one, two;
  const Prediction a = Walk(&one, {0, 2, 1});
  const Prediction b = Walk(&two, {0, 2, 1});
  EXPECT_EQ(a.h, b.h);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.q, b.q);
  EXPECT_NE(a.h, Walk(&one, {0, 1, 2}).h);
  EXPECT_EQ(one.weights_hash(), two.weights_hash());
  EXPECT_EQ(one.fingerprint(), two.fingerprint());
}

TEST(ScriptedEngine, TheRootIsDoneAndOffersTheFirstActions) {
  ScriptedEngine engine;
  const Prediction root = Walk(&engine, {});
  EXPECT_EQ(root.done, 1.0F);
  for (int a = 0; a < 7; ++a) EXPECT_EQ(root.p[static_cast<std::size_t>(a)] > 0.01F, a < 4);
  EXPECT_LT(Walk(&engine, {2}).p[2], 0.01F) << "the action just done";
}

TEST(ScriptedEngine, SomeActionsFailAndAllNumbersAreProbabilities) {
  ScriptedEngine engine;
  int failed = 0, all = 0;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 4; ++b) {
      for (int c = 0; c < 4; ++c, ++all) {
        const Prediction at = Walk(&engine, {a, b, c});
        failed += at.done < 0.1F;
        EXPECT_TRUE(at.value > 0 && at.value <= 1 && at.done > 0 && at.done <= 1);
      }
    }
  }
  EXPECT_GT(failed, all / 10);
  EXPECT_LT(failed, all / 2);
}

TEST(ScriptedEngine, OptionsChooseTheTree) {
  ScriptedEngine never({"made", 3, 3, 0.0, 9, 8, 8, 0.5});
  EXPECT_GT(Walk(&never, {0, 1}).done, 0.5F);
  EXPECT_EQ(never.info().num_actions, 3);
  EXPECT_EQ(never.Decode({Walk(&never, {1}).h})[0].size(), 8U * 8U * 3U);
  EXPECT_NE(never.weights_hash(), ScriptedEngine().weights_hash());
  EXPECT_THROW(Walk(&never, {3}), std::invalid_argument);
}

/// What `question` is refused with.
template <class Question>
std::string Refusal(const Question& question) {
  try {
    question();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

// Checked by the interface itself, so for every engine.
TEST(Engine, RefusesWrongSizesAndActionsAndSaysWhatIsExpected) {
  ScriptedEngine engine({"made", 3, 3, 0.0, 9, 8, 8, 0.5});
  const std::vector<std::uint8_t> picture(8 * 8 * 3), larger(8 * 9 * 3);
  const Hidden state(4), shorter(3);
  const std::string bytes = ": a picture of 216 bytes, where 192 are expected";
  const std::string numbers = ": a state of 3 numbers, where 4 are expected";
  EXPECT_EQ(Refusal([&] { engine.Encode(larger); }), "Encode" + bytes);
  EXPECT_EQ(Refusal([&] { engine.Encode({}); }),
            "Encode: a picture of 0 bytes, where 192 are expected");
  EXPECT_EQ(Refusal([&] { engine.Classify(larger); }), "Classify" + bytes);
  EXPECT_EQ(Refusal([&] { engine.Evaluate(shorter, state, 0); }), "Evaluate" + numbers);
  EXPECT_EQ(Refusal([&] { engine.Evaluate(state, shorter, 0); }), "Evaluate" + numbers);
  EXPECT_EQ(Refusal([&] { engine.Evaluate(state, state, 4); }),
            "Evaluate: action 4, where 0 to 3 are expected");
  EXPECT_EQ(Refusal([&] {
              engine.Expand({{state, state, 0}, {shorter, state, 0}});
            }),
            "Expand" + numbers);
  EXPECT_EQ(Refusal([&] { engine.Expand({{state, shorter, 0}}); }), "Expand" + numbers);
  EXPECT_EQ(Refusal([&] {
              engine.Expand({{state, state, 3}});
            }),
            "Expand: action 3, where 0 to 2 are expected");
  EXPECT_EQ(Refusal([&] {
              engine.Expand({{state, state, -1}});
            }),
            "Expand: action -1, where 0 to 2 are expected");
  EXPECT_EQ(Refusal([&] { engine.Decode({state, shorter}); }), "Decode" + numbers);
  EXPECT_EQ(Refusal([&] { engine.DecodeOnto(larger, state, {state}); }), "DecodeOnto" + bytes);
  EXPECT_EQ(Refusal([&] { engine.DecodeOnto(picture, shorter, {state}); }), "DecodeOnto" + numbers);
  EXPECT_EQ(Refusal([&] { engine.DecodeOnto(picture, state, {shorter}); }), "DecodeOnto" + numbers);
  EXPECT_EQ(Refusal([&] { engine.DecodeOnto(picture, state, {state}); }), "");
}

TEST(RowPool, DoesEveryRowOnce) {
  for (const int threads : {1, 2, 5}) {
    RowPool pool(threads, [] {});
    for (const std::size_t rows : {0UL, 1UL, 3UL, 100UL}) {
      std::vector<std::atomic<int>> done(rows);
      pool.Run(rows, [&](std::size_t i) { ++done[i]; });
      for (const auto& count : done) EXPECT_EQ(count, 1);
    }
  }
}

TEST(RowPool, PassesAFailureOnAndGoesOnWorking) {
  RowPool pool(3, [] {});
  EXPECT_THROW(pool.Run(20,
                        [](std::size_t i) {
                          if (i == 7) throw std::runtime_error("row");
                        }),
               std::runtime_error);
  std::atomic<int> count{0};
  pool.Run(20, [&](std::size_t) { ++count; });
  EXPECT_EQ(count, 20);
}

}  // namespace
}  // namespace prospect::model

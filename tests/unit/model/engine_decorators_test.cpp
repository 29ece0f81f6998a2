// What stands around an engine changes its time and its memory, never its answers.

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "model/caching_engine.h"
#include "model/fixed_cost_engine.h"
#include "model/recorded_engine.h"
#include "model/scripted_engine.h"
#include "tests/unit/model/test_folder.h"

namespace prospect::model {
namespace {

const std::vector<std::uint8_t> kPicture(64 * 64 * 3, 7);

/// The scripted engine, with a count of what it was asked.
class CountingEngine : public EngineDecorator {
 public:
  explicit CountingEngine(int* rows)
      : EngineDecorator(std::make_unique<ScriptedEngine>()), rows_(rows) {}

 protected:
  Prediction DoEvaluate(std::span<const float> h0, std::span<const float> h,
                        int previous) override {
    ++*rows_;
    return EngineDecorator::DoEvaluate(h0, h, previous);
  }
  std::vector<Prediction> DoExpand(const std::vector<ExpandInput>& rows) override {
    *rows_ += static_cast<int>(rows.size());
    return EngineDecorator::DoExpand(rows);
  }

 private:
  int* rows_;
};

void ExpectEqual(const Prediction& a, const Prediction& b) {
  EXPECT_EQ(a.h, b.h);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.done, b.done);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.p, b.p);
}

TEST(CachingEngine, ComputesEqualRowsOnce) {
  int rows = 0;
  CachingEngine engine(std::make_unique<CountingEngine>(&rows), 1 << 20);
  ScriptedEngine plain;
  const Hidden root = engine.Encode(kPicture);
  const Hidden copy = root;  // other memory, equal content
  const auto once = engine.Expand({{root, root, 1}, {copy, copy, 2}, {root, copy, 1}});
  EXPECT_EQ(rows, 2);
  const auto again = engine.Expand({{copy, root, 2}, {root, root, 3}});
  EXPECT_EQ(rows, 3);
  EXPECT_EQ(engine.misses(), 4) << "one picture, three rows";
  EXPECT_EQ(engine.hits(), 2);
  const auto expected = plain.Expand({{root, root, 1}, {root, root, 2}, {root, root, 3}});
  ExpectEqual(once[0], expected[0]);
  ExpectEqual(once[1], expected[1]);
  ExpectEqual(once[2], expected[0]);
  ExpectEqual(again[0], expected[1]);
  ExpectEqual(again[1], expected[2]);
}

TEST(CachingEngine, TellsQuestionsApart) {
  int rows = 0;
  CachingEngine engine(std::make_unique<CountingEngine>(&rows), 1 << 20);
  const Hidden root = engine.Encode(kPicture);
  const auto child = engine.Expand({{root, root, 1}}).front();
  EXPECT_TRUE(engine.Evaluate(root, root, 1).h.empty());
  engine.Evaluate(root, root, 2);
  engine.Evaluate(root, child.h, 1);
  engine.Evaluate(child.h, root, 1);
  EXPECT_EQ(rows, 5);
}

TEST(CachingEngine, KeepsWithinItsBudgetAndForgetsTheOldest) {
  int rows = 0;
  const std::size_t budget = 1000;
  CachingEngine engine(std::make_unique<CountingEngine>(&rows), budget);
  const Hidden root = engine.Encode(kPicture);
  for (int action = 0; action < 7; ++action) {
    engine.Expand({{root, root, action}});
    EXPECT_LE(engine.bytes(), budget);
  }
  engine.Expand({{root, root, 6}});
  EXPECT_EQ(rows, 7) << "the latest is remembered";
  engine.Expand({{root, root, 0}});
  EXPECT_EQ(rows, 8) << "the oldest is not";
}

TEST(FixedCostEngine, TakesTheModelledTimeAndChangesNoAnswer) {
  FixedCostEngine engine(std::make_unique<ScriptedEngine>(), {10, 2});
  ScriptedEngine plain;
  const Hidden root = plain.Encode(kPicture);
  const std::vector<ExpandInput> rows(5, {root, root, 1});
  const auto begun = std::chrono::steady_clock::now();
  const auto answers = engine.Expand(rows);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
  EXPECT_GE(took.count(), 20.0);
  ExpectEqual(answers.front(), plain.Expand(rows).front());
  EXPECT_THROW(FixedCostEngine(std::make_unique<ScriptedEngine>(), {-1, 0}), std::invalid_argument);
}

TEST(RecordingEngine, ReplaysEveryKindOfAnswer) {
  const TestFolder folder;
  const std::string path = folder / "answers.bin";
  ScriptedEngine plain;
  Hidden root;
  {
    RecordingEngine recording(std::make_unique<ScriptedEngine>(), path);
    root = recording.Encode(kPicture);
    recording.Evaluate(root, root, 7);
    recording.Expand({{root, root, 1}, {root, root, 2}});
    recording.Decode({root});
    recording.Classify(kPicture);
  }
  ReplayEngine replay(path);
  EXPECT_EQ(replay.size(), 6u);
  EXPECT_EQ(replay.weights_hash(), plain.weights_hash());
  EXPECT_EQ(replay.fingerprint(), plain.fingerprint());
  EXPECT_EQ(replay.info().num_actions, plain.info().num_actions);
  EXPECT_EQ(replay.Encode(kPicture), root);
  ExpectEqual(replay.Evaluate(root, root, 7), plain.Evaluate(root, root, 7));
  ExpectEqual(replay.Expand({{root, root, 2}}).front(), plain.Expand({{root, root, 2}}).front());
  EXPECT_EQ(replay.Decode({root}), plain.Decode({root}));
  EXPECT_EQ(replay.Classify(kPicture), plain.Classify(kPicture));
  EXPECT_THROW(replay.Expand({{root, root, 3}}), std::runtime_error);
}

TEST(ReplayEngine, ACutFileReplaysItsWholeAnswersAndOtherFilesAreRefused) {
  const TestFolder folder;
  Hidden root;
  {
    RecordingEngine recording(std::make_unique<ScriptedEngine>(), folder / "whole.bin");
    root = recording.Encode(kPicture);
    recording.Expand({{root, root, 1}});
  }
  const auto size = std::filesystem::file_size(folder / "whole.bin");
  std::filesystem::resize_file(folder / "whole.bin", size - 3);
  ReplayEngine replay(folder / "whole.bin");
  EXPECT_EQ(replay.size(), 1u);
  EXPECT_EQ(replay.Encode(kPicture), root);

  std::ofstream(folder / "other.bin") << "something else";
  EXPECT_THROW(ReplayEngine(folder / "other.bin"), std::runtime_error);
  EXPECT_THROW(ReplayEngine(folder / "missing.bin"), std::runtime_error);
}

}  // namespace
}  // namespace prospect::model

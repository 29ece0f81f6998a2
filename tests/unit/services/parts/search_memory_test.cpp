#include "services/model/search_memory.h"

#include <gtest/gtest.h>

#include "model/engine_decorator.h"
#include "model/scripted_engine.h"
#include "services/model/picture_encoder.h"

namespace prospect::services {
namespace {

using planner::Path;

model::ScriptedOptions AllOffered() {
  model::ScriptedOptions options;
  options.offered_actions = options.num_actions;
  return options;
}

class SearchMemoryTest : public testing::Test {
 protected:
  std::unique_ptr<SearchMemory> Make(std::size_t bytes, const Path& executed = {}) {
    auto memory = std::make_unique<SearchMemory>(engine, planner::AnyOrder(7, 4), executed, bytes);
    const std::vector<std::uint8_t> picture(64 * 64 * 3, 9);
    memory->SetRoot(engine.Encode(picture), engine.Encode(picture));
    return memory;
  }

  static bool Same(const evaluation_t& a, const evaluation_t& b) {
    return a.value == b.value && a.done == b.done && a.actions == b.actions && a.q == b.q &&
           a.p == b.p;
  }

  model::ScriptedEngine engine{AllOffered()};
};

TEST_F(SearchMemoryTest, DeepPathBringsItsPrefixesAlong) {
  auto memory = Make(1 << 20);
  EXPECT_EQ(memory->Compute({{1, 2, 3}}, 16), 3);
  EXPECT_TRUE(memory->Knows({1, 2}));
  EXPECT_TRUE(memory->Knows({1}));
  EXPECT_FALSE(memory->Knows({}));
  EXPECT_EQ(memory->Compute({{1, 2, 3}, {1, 2, 0}, {}}, 16), 2) << "only what is new is computed";
}

TEST_F(SearchMemoryTest, AnswersDoNotDependOnWhatIsKept) {
  auto large = Make(1 << 20);
  auto tiny = Make(1);  // keeps no hidden state at all
  const std::vector<Path> paths{{}, {0}, {0, 1}, {2, 1, 0}, {2, 1, 3}, {6, 5, 4, 3}};
  large->Compute(paths, 16);
  for (const auto& path : paths) {
    tiny->Compute({path}, 1);
    EXPECT_TRUE(Same(large->Evaluation(path), tiny->Evaluation(path))) << planner::ToString(path);
    EXPECT_EQ(large->State(path), tiny->State(path)) << planner::ToString(path);
  }
  EXPECT_EQ(tiny->hidden_bytes(), 0u);
}

// Counts the calls of Expand: each costs an engine its fixed part.
class CallCounter : public model::EngineDecorator {
 public:
  explicit CallCounter(std::vector<std::size_t>* calls)
      : EngineDecorator(std::make_unique<model::ScriptedEngine>(AllOffered())), calls_(calls) {}

 protected:
  std::vector<model::Prediction> DoExpand(const std::vector<model::ExpandInput>& rows) override {
    calls_->push_back(rows.size());
    return EngineDecorator::DoExpand(rows);
  }

 private:
  std::vector<std::size_t>* calls_;
};

TEST_F(SearchMemoryTest, PathsOfAllLengthsShareABatch) {
  std::vector<std::size_t> calls;
  CallCounter counter(&calls);
  SearchMemory memory(counter, planner::AnyOrder(7, 4), {}, 1 << 20);
  const std::vector<std::uint8_t> picture(64 * 64 * 3, 9);
  memory.SetRoot(counter.Encode(picture), counter.Encode(picture));
  memory.Compute({{1, 2, 3}}, 16);
  EXPECT_EQ(calls, (std::vector<std::size_t>{1, 1, 1}));
  calls.clear();
  EXPECT_EQ(memory.Compute({{0}, {1, 0}, {1, 2, 0}, {1, 2, 3, 0}, {}}, 16), 5);
  EXPECT_EQ(calls, (std::vector<std::size_t>{4}));
  calls.clear();
  EXPECT_EQ(memory.Compute({{4, 5}, {4}, {4, 6}}, 16), 3);
  EXPECT_EQ(calls, (std::vector<std::size_t>{1, 2}));
}

TEST_F(SearchMemoryTest, OnlyAllowedActionsAreTold) {
  auto memory = Make(1 << 20, {4});
  memory->Compute({{2}}, 16);
  EXPECT_EQ(memory->Evaluation({2}).actions, (std::vector<std::uint8_t>{0, 1, 3, 5, 6}));
  EXPECT_FALSE(memory->Legal({4}));
  EXPECT_FALSE(memory->Legal({2, 2}));
}

TEST_F(SearchMemoryTest, NeedsTheRootsPictures) {
  SearchMemory memory(engine, planner::AnyOrder(7, 4), {}, 1 << 20);
  EXPECT_FALSE(memory.ready());
  EXPECT_THROW(memory.Compute({{1}}, 16), std::logic_error);
}

// Counts how often pictures are really encoded.
class CountingEngine : public model::ScriptedEngine {
 public:
  int encoded = 0;

 protected:
  model::Hidden DoEncode(model::Pixels picture) override {
    ++encoded;
    return model::ScriptedEngine::DoEncode(picture);
  }
};

TEST(PictureEncoderTest, SamePictureIsEncodedOnceWhileRemembered) {
  CountingEngine engine;
  PictureEncoder encoder(engine, 2);
  const auto picture = [](std::uint8_t shade) {
    return std::vector<std::uint8_t>(64 * 64 * 3, shade);
  };
  for (const int shade : {1, 2, 1, 2, 1}) encoder.Encode(picture(static_cast<std::uint8_t>(shade)));
  EXPECT_EQ(engine.encoded, 2);
  encoder.Encode(picture(3));
  encoder.Encode(picture(2));
  EXPECT_EQ(engine.encoded, 4) << "the one unused for longest is forgotten";
}

}  // namespace
}  // namespace prospect::services

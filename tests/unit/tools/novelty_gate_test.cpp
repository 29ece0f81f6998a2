// With the bundled weights and pictures of the simulator.

#include <gtest/gtest.h>

#include "planner/baseline_plans.h"
#include "sim/task_factory.h"
#include "tools/evaluate/decider.h"
#include "tools/evaluate/episode.h"
#include "tools/evaluate/first_picture.h"

namespace prospect::tools {
namespace {

constexpr std::uint64_t kFirst = 1'420'000;  // tuning scenes: never in a reported figure
constexpr int kFit = 240, kRank = 160, kFresh = 60;
constexpr double kLevel = 0.05;

// Networks and what they know of the task's pictures; made once.
struct Known {
  std::unique_ptr<model::Engine> engine;
  std::unique_ptr<sim::Task> task;
  std::unique_ptr<model::NoveltyGauge> gauge;
  std::vector<model::NoveltySample> fresh;  // of further scenes

  Known()
      : engine(model::LoadEngine(
            std::string(PROSPECT_ROOT) + "/model/weights/navigation.safetensors", 1)),
        task(sim::MakeTask("navigation")) {
    std::vector<model::NoveltySample> fit, rank;
    for (int i = 0; i < kFit + kRank + kFresh; ++i) {
      const auto picture = FirstPicture(*task, kFirst + static_cast<std::uint64_t>(i), 0.01);
      auto& list = i < kFit ? fit : i < kFit + kRank ? rank : fresh;
      list.push_back(model::TakeNoveltySample(*engine, picture));
    }
    gauge = std::make_unique<model::NoveltyGauge>(fit, rank);
  }

  double P(const std::vector<std::uint8_t>& picture) const {
    return gauge->Judge(model::TakeNoveltySample(*engine, picture)).p;
  }
};

const Known& TheKnown() {
  static const Known known;
  return known;
}

// Begins with a legal action, whatever it sees.
class Bold : public LocalMind {
 public:
  void Enter(sim::Task& task, std::uint64_t) override { task_ = &task; }

 private:
  agent::SearchAnswer Find(const agent::SearchQuestion&) override {
    agent::SearchAnswer answer;
    answer.plan = planner::PlanOf({static_cast<std::uint8_t>(task_->LegalActions().at(0))}, "");
    return answer;
  }

  sim::Task* task_ = nullptr;
};

std::unique_ptr<Decider> GatedBold(const Known& known, double level) {
  auto decider = std::make_unique<Decider>();
  decider->mind = std::make_unique<Bold>();
  return MakeNoveltyGate(std::move(decider), known.engine.get(), *known.gauge, level);
}

TEST(NoveltyGate, KnownPicturesPassAtAboutTheChosenRate) {
  const Known& known = TheKnown();
  int refused = 0;
  for (const auto& sample : known.fresh) refused += known.gauge->Judge(sample).p < kLevel;
  EXPECT_LE(refused, kFresh * kLevel * 3);
}

TEST(NoveltyGate, ForeignPicturesDoNot) {
  const Known& known = TheKnown();
  const double least = 2.0 / (kRank + 1);
  EXPECT_DOUBLE_EQ(known.P(std::vector<std::uint8_t>(64 * 64 * 3, 128)), least) << "grey";
  EXPECT_DOUBLE_EQ(known.P(std::vector<std::uint8_t>(64 * 64 * 3, 0)), least) << "black";
  const auto other = sim::MakeTask("stacking");
  EXPECT_DOUBLE_EQ(known.P(FirstPicture(*other, kFirst, 0.01)), least) << "the other task";
  for (const char* factor : {"light", "camera", "colour", "noise"}) {
    sim::TaskOptions options;
    sim::SetShift(factor, sim::kShiftStrengths, &options);
    const auto shifted = sim::MakeTask("navigation", options);
    EXPECT_LT(known.P(FirstPicture(*shifted, kFirst, options.image_noise)), kLevel) << factor;
  }
}

TEST(NoveltyGate, RefusesBeforeTheFirstActionAndSaysWhy) {
  const Known& known = TheKnown();
  sim::TaskOptions options;
  sim::SetShift("colour", sim::kShiftStrengths, &options);
  const auto foreign = sim::MakeTask("navigation", options);
  const auto gate = GatedBold(known, kLevel);
  const EpisodeRecord refused = RunEpisode(*foreign, *gate, kFirst, options.image_noise);
  EXPECT_EQ(refused.ending, Ending::kRefused);
  EXPECT_TRUE(refused.actions.empty());
  EXPECT_EQ(refused.reason.find("this picture is unlike what the networks were trained on (p 0.0"),
            0u)
      << refused.reason;
  const EpisodeRecord usual = RunEpisode(*known.task, *gate, kFirst, 0.01);
  EXPECT_NE(usual.ending, Ending::kRefused) << usual.reason;
  const auto open = GatedBold(known, 0);
  EXPECT_NE(RunEpisode(*foreign, *open, kFirst, 0.01).ending, Ending::kRefused);
}

}  // namespace
}  // namespace prospect::tools

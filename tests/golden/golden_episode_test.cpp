// A whole episode: what is seen, searched, decided and done in some scenes, as one number. Like the
// others (golden_test.cpp) it may change only where that is meant.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "base/hash.h"
#include "model/scripted_engine.h"
#include "planner/search_parameters.h"
#include "sim/task_factory.h"
#include "tools/evaluate/decider.h"
#include "tools/evaluate/episode.h"
#include "tools/evaluate/search_deciders.h"

namespace prospect::tools {
namespace {

constexpr std::uint64_t kFirstScene = 1'400'000;  // tuning scenes: in no figure
constexpr int kScenes = 12;

// What happened, but for times by the wall clock.
std::string Text(const EpisodeRecord& record) {
  std::string text = std::string(ToString(record.ending)) + " (" + record.reason + ")";
  for (const int action : record.actions) text += ' ' + std::to_string(action);
  for (const double score : record.scores) text += " s" + std::to_string(std::llround(score * 1e6));
  return text + " e" + std::to_string(record.evaluations) + " r" + std::to_string(record.rollouts);
}

std::unique_ptr<model::Engine> EngineFor(const sim::TaskSpec& spec, std::uint64_t tree) {
  model::ScriptedOptions options;
  options.task = spec.name;
  options.num_actions = static_cast<int>(spec.actions.size());
  options.offered_actions = options.num_actions;
  options.failing_share = 0.1;
  options.seed = tree;
  options.image_width = spec.image_width;
  options.image_height = spec.image_height;
  return std::make_unique<model::ScriptedEngine>(options);
}

// In the real world of physics, with networks that are pure functions: no processor's rounding
// decides anything but where the robot comes to stand.
TEST(Episode, GoesAsBefore) {
  const auto task = sim::MakeTask("navigation");
  planner::SearchParameters search;
  search.samples = 60;
  std::string text;
  for (int i = 0; i < kScenes; ++i) {
    const auto seed = kFirstScene + static_cast<std::uint64_t>(i);
    const auto engine = EngineFor(task->spec(), seed);
    const auto decider = MakeLearned(PlanBy::kSearch, engine.get(), search);
    text += Text(RunEpisode(*task, *decider, seed, 0.01)) + '\n';
  }
  EXPECT_EQ(base::HexText(base::HashText(text)), "33373ecf6a5e2dbc") << text;
}

}  // namespace
}  // namespace prospect::tools

#include "tools/evaluate/closed_loop.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "base/exit_error.h"
#include "cli/commands/evaluate.h"
#include "model/novelty.h"
#include "model/surprise.h"
#include "planner/goal.h"
#include "planner/selection_rule.h"
#include "tools/common/words.h"
#include "tools/evaluate/calibrate.h"
#include "tools/evaluate/report.h"
#include "tools/evaluate/rule.h"
#include "tools/evaluate/scene_bench.h"
#include "tools/evaluate/simulated_world.h"

namespace prospect::tools {
namespace {

void RequireFolder(const std::string& folder) {
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw std::invalid_argument("--videos " + folder + ": " + error.message());
}

void RequireRows(const std::vector<std::string>& rows) {
  const std::vector<std::string> known = cli::EvaluateOptions().rows;
  for (const std::string& row : rows) {
    if (std::find(known.begin(), known.end(), row) != known.end()) continue;
    if (NumberOf(row, "samples") || NumberOf(row, "simulator_model")) continue;
    throw std::invalid_argument(
        "unknown row '" + row +
        "'; known: planner, nothing, random, greedy, exhaustive, simulator_model, samples=N, "
        "simulator_model=N");
  }
}

// The scenes to run: so many in a row, or the first of each class.
std::vector<std::uint64_t> SeedsOf(const ClosedLoop& options) {
  if (options.wanted.total() > 0) {
    return DrawScenes(options.wanted, options.seed, options.jobs, [&]() -> ClassOf {
      auto bench = std::make_shared<SceneBench>(options);
      return [bench](std::uint64_t seed) { return bench->ClassOf(seed); };
    });
  }
  std::vector<std::uint64_t> seeds(static_cast<std::size_t>(options.scenes));
  std::iota(seeds.begin(), seeds.end(), options.seed);
  return seeds;
}

[[noreturn]] void RefuseGoal(const planner::GoalError& error) {
  throw ExitError(kExitRefusal, std::string("the goal cannot be brought about: ") + error.what());
}

Goal GoalOf(const std::string& text, const ClosedLoop& loop) {
  try {
    return planner::ResolveGoal(planner::ParseGoal(text),
                                GoalsOf(sim::MakeTask(loop.task, loop.world)->spec()));
  } catch (const planner::GoalError& error) {
    RefuseGoal(error);
  }
}

}  // namespace

void Ask(const cli::SearchOptions& search, const std::string& goal, ClosedLoop* loop) {
  loop->search.samples = search.samples;
  loop->search.workers = search.workers;
  loop->search.depth = search.depth;
  loop->search.UseRule(search.rule.empty() ? RuleOf(loop->weights, KindAsked(*loop)) : search.rule);
  if (search.v_failed) loop->search.v_failed = *search.v_failed;
  loop->retries = search.retries;
  loop->surprise = search.surprise.value_or(model::kSurprising);
  if (!goal.empty()) loop->goal = GoalOf(goal, *loop);
}

void CheckInputs(const ClosedLoop& loop) {
  RequireRows(loop.rows);
  planner::MakeSelectionRule(loop.search.rule, 1, 1);
  try {
    RulesOf(sim::MakeTask(loop.task, loop.world)->spec(), loop.goal);
  } catch (const planner::GoalError& error) {
    RefuseGoal(error);
  }
  RequireWeightsOf(loop.task, loop.weights);
  RequireFolder(loop.videos);
  if (loop.novelty > 0) WarnWithoutNovelty(loop.weights);
}

model::SceneKind KindAsked(const ClosedLoop& options) {
  const auto task = sim::MakeTask(options.task, options.world);
  task->Reset(options.seed);
  return KindOf(*task);
}

Items ScenesOf(const ClosedLoop& loop, std::uint64_t weights_hash) {
  return {"scenes", loop.scenes, loop.jobs, SceneSource(loop.task, loop.world, weights_hash)};
}

SceneRuns RunClosedLoops(const ClosedLoop& loop, Items scenes) {
  const std::vector<std::uint64_t> seeds = SeedsOf(loop);
  scenes.count = static_cast<int>(seeds.size());
  SceneRuns runs = RunScenes(loop.shard, scenes, seeds, [&]() -> SceneRun {
    auto bench = std::make_shared<SceneBench>(loop);
    return [bench](std::uint64_t seed) { return bench->Run(seed); };
  });
  if (loop.wanted.total() > 0) runs.extent.wanted = loop.wanted.total();
  return runs;
}

void Tell(const ClosedLoop& loop, const SceneRuns& runs) {
  if (!loop.goal.empty()) Words() << "goal: " << planner::ToString(loop.goal) << "\n";
  Words() << Table(Summarise(runs.records, loop.rows), loop.rows) << runs.extent.Line("scenes");
}

nlohmann::json ReportOf(const ClosedLoop& loop, const SceneRuns& runs) {
  nlohmann::json report = Summarise(runs.records, loop.rows);
  report["task"] = loop.task;
  report["goal"] = planner::ToString(loop.goal);
  report["first_seed"] = loop.seed;
  report["objects"] = loop.world.objects;
  report["legs"] = loop.world.legs;
  report["tower"] = loop.world.tower;
  report["scene_file"] = loop.world.scene_file;
  report["samples"] = loop.search.samples;
  report["open_loop"] = loop.open_loop;
  report["novelty"] = loop.novelty;
  report["threshold"] = loop.threshold;
  runs.extent.Put(&report);
  report["records"] = runs.records;
  return report;
}

}  // namespace prospect::tools

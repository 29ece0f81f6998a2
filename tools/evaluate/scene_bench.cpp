#include "tools/evaluate/scene_bench.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "cli/installation.h"
#include "model/engine.h"
#include "model/novelty.h"
#include "sim/oracle_cache.h"
#include "sim/task_factory.h"
#include "tools/evaluate/episode.h"
#include "tools/evaluate/recovery.h"
#include "tools/evaluate/scene_video.h"
#include "tools/evaluate/search_deciders.h"

namespace prospect::tools {

using nlohmann::json;

std::optional<int> NumberOf(const std::string& row, const std::string& name) {
  const std::string prefix = name + "=";
  if (row.rfind(prefix, 0) != 0) return std::nullopt;
  const std::string digits = row.substr(prefix.size());
  const bool number = !digits.empty() && digits.size() < 7 &&
                      digits.find_first_not_of("0123456789") == std::string::npos;
  if (!number || std::stoi(digits) < 1)
    throw std::invalid_argument("row '" + row + "': give " + prefix + "1 to " + prefix + "999999");
  return std::stoi(digits);
}

class SceneBench::Impl {
 public:
  explicit Impl(const ClosedLoop& options)
      : options_(options),
        task_(sim::MakeTask(options.task, options.world)),
        engine_(model::LoadSearchEngine(options.weights, 1)),
        gauge_(model::NoveltyGauge::Load(options.weights)),
        cache_(sim::OracleKeyOf(*task_, options.world.objects), "",
               cli::DataFolder("config/oracle")) {
    if (!options.goal.empty()) {
      sim::OracleKey key = sim::OracleKeyOf(*task_, options.world.objects);
      key.goal = planner::ToString(options.goal);
      goal_cache_.emplace(key);
    }
    planner::SearchParameters search = options.search;
    search.refusal_threshold =
        options.threshold >= 0 ? options.threshold : engine_->info().refusal_threshold;
    for (const std::string& row : options.rows) {
      std::unique_ptr<Decider> decider = Make(row, search);
      if (options.open_loop) decider = MakeOpenLoop(std::move(decider));
      deciders_.emplace_back(row, std::move(decider));
    }
  }

  SceneRecord Run(std::uint64_t seed) {
    const sim::OracleResult oracle = Consult(seed);
    SceneRecord scene = {{"seed", seed},
                         {"class", sim::ToString(oracle.scene_class)},
                         {"oracle_success", oracle.success_frequency()},
                         {"random_plan_success", 1 - oracle.random_failure_share()}};
    task_->Reset(seed);
    scene["solved_at_start"] = task_->progress().outcome == sim::Outcome::kSuccess;
    for (auto& [name, decider] : deciders_) {
      std::optional<Recovery> lost;
      const AfterAction look = [&](sim::Task& task) {
        if (!lost) lost = ConsultRecovery(task, seed);
      };
      json& row = scene["rows"][name];
      const bool planner = name == "planner";
      const EpisodeRecord episode = RunEpisode(*task_, *decider, seed, options_.world.image_noise,
                                               options_.goal, planner ? look : AfterAction());
      row = ToJson(episode);
      if (planner && !options_.videos.empty())
        row["video"] = WriteSceneVideo(*task_, seed, episode, options_.videos);
      if (lost) row["lost"] = {{"anew", sim::ToString(lost->anew)}, {"time", lost->time}};
    }
    return scene;
  }

  // What the oracle says of a scene; for drawing scenes.
  sim::SceneClass ClassOf(std::uint64_t seed) {
    task_->Reset(seed);
    return Consult(seed).scene_class;
  }

 private:
  // With a goal, what the oracle of the whole task knows is used again.
  sim::OracleResult Consult(std::uint64_t seed) {
    const auto known = goal_cache_ ? goal_cache_->Find(seed) : std::nullopt;
    if (known) return *known;
    const sim::OracleResult all = sim::ConsultOracleCached(*task_, seed, cache_);
    if (!goal_cache_) return all;
    const planner::TaskRules rules = RulesOf(task_->spec(), options_.goal);
    const sim::OracleResult narrow = sim::NarrowOracle(
        *task_, seed, all,
        [&](const std::vector<int>& plan) {
          return rules.GoalMet({plan.begin(), plan.end()}, {});
        },
        [&](const sim::Task& task) { return planner::Holds(options_.goal, task.Facts()); });
    goal_cache_->Store(seed, narrow);
    return narrow;
  }

  std::unique_ptr<Decider> Make(const std::string& row, const planner::SearchParameters& search) {
    const Goal& goal = options_.goal;
    const int retries = options_.retries;
    const double surprise = options_.surprise;
    if (row == "planner")
      return Gated(MakeLearned(PlanBy::kSearch, engine_.get(), search, goal, retries, surprise));
    if (const std::optional<int> samples = NumberOf(row, "samples")) {
      planner::SearchParameters other = search;
      other.samples = *samples;
      return Gated(MakeLearned(PlanBy::kSearch, engine_.get(), other, goal, retries, surprise));
    }
    if (row == "exhaustive")
      return Gated(
          MakeLearned(PlanBy::kExhaustive, engine_.get(), search, goal, retries, surprise));
    if (row == "greedy") return Gated(MakeLearned(PlanBy::kGreedy, engine_.get(), search, goal));
    if (row == "simulator_model") return MakeSimulatorModel(1, search, goal, retries);
    if (const std::optional<int> runs = NumberOf(row, "simulator_model"))
      return MakeSimulatorModel(*runs, search, goal, retries);
    if (row == "random") return MakeRandom(goal);
    if (row == "nothing") return MakeNothing();
    throw std::logic_error("row " + row + " was checked before");
  }

  // Whatever the networks say of a picture that they cannot know means nothing.
  std::unique_ptr<Decider> Gated(std::unique_ptr<Decider> decider) {
    if (!gauge_ || options_.novelty <= 0) return decider;
    return MakeNoveltyGate(std::move(decider), engine_.get(), *gauge_, options_.novelty);
  }

  ClosedLoop options_;
  std::unique_ptr<sim::Task> task_;
  std::unique_ptr<model::Engine> engine_;
  std::optional<model::NoveltyGauge> gauge_;
  sim::OracleCache cache_;
  std::optional<sim::OracleCache> goal_cache_;
  std::vector<std::pair<std::string, std::unique_ptr<Decider>>> deciders_;
};

SceneBench::SceneBench(const ClosedLoop& loop) : impl_(std::make_unique<Impl>(loop)) {}
SceneBench::~SceneBench() = default;

SceneRecord SceneBench::Run(std::uint64_t seed) { return impl_->Run(seed); }
sim::SceneClass SceneBench::ClassOf(std::uint64_t seed) { return impl_->ClassOf(seed); }

}  // namespace prospect::tools

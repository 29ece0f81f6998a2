// prospect-evaluate: closed loop on scenes that nothing was trained or tuned on, with the oracle's
// verdict and plain baselines beside the planner. Needs no bus: the same planner, networks and
// world as the services, in one process a job.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numeric>
#include <optional>
#include <sstream>

#include "base/json_file.h"
#include "base/run_main.h"
#include "model/calibration.h"
#include "model/engine.h"
#include "model/surprise.h"
#include "planner/selection_rule.h"
#include "sim/oracle.h"
#include "sim/oracle_cache.h"
#include "sim/task_factory.h"
#include "tools/common/scene_options.h"
#include "tools/evaluate/calibrate.h"
#include "tools/evaluate/decider.h"
#include "tools/evaluate/episode.h"
#include "tools/evaluate/recovery.h"
#include "tools/evaluate/report.h"
#include "tools/evaluate/scene_draw.h"
#include "tools/evaluate/scene_runs.h"
#include "tools/evaluate/scene_video.h"
#include "tools/evaluate/search_deciders.h"
#include "tools/evaluate/shift_options.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

constexpr int kMostCalibrationScenes = 10000;  // CALIBRATION is one datagram

struct Options {
  std::string task = "navigation";
  std::string weights;
  std::string json_file;
  std::string videos;  // folder; empty: none
  std::string goal_text;
  Goal goal;  // what goal_text says
  int scenes = 100;
  ScenesWanted wanted;
  int retries = 1;
  double surprise = model::kSurprising;
  std::uint64_t seed = 2'000'000;
  sim::TaskOptions world;
  ShiftOptions shift;
  planner::SearchParameters search;
  double threshold = -1;
  bool calibrate = false;
  model::Promise promise;
  int jobs = 2;
  std::vector<std::string> rows = {"planner", "nothing",    "random",
                                   "greedy",  "exhaustive", "simulator_model"};
};

void AddOptions(CLI::App* app, Options* o) {
  app->add_option("--task", o->task, "Task")->capture_default_str();
  app->add_option("--weights", o->weights, "Weights file")->required();
  CLI::Option* scenes = app->add_option("--scenes", o->scenes, "Scenes, in seed order")
                            ->check(CLI::Range(1, 1000000))
                            ->capture_default_str();
  app->add_option("--solvable", o->wanted.solvable,
                  "Instead of --scenes: the first so many solvable scenes, in seed order")
      ->check(CLI::Range(0, 100000))
      ->excludes(scenes);
  app->add_option("--hopeless", o->wanted.hopeless, "The same of hopeless scenes")
      ->check(CLI::Range(0, 100000))
      ->excludes(scenes);
  app->add_option("--seed", o->seed,
                  "First scene; 1000000 and up, since lower seeds are for training")
      ->check(CLI::Range(std::uint64_t{1'000'000}, std::uint64_t{1} << 40))
      ->capture_default_str();
  AddSceneOptions(app, &o->world);
  app->add_option(
      "--goal", o->goal_text,
      "What is to hold in the end, such as \"on(red,blue)\" or "
      "\"visited(barrel,pylon)\", for every row and the oracle; without: the task's own");
  app->add_option("--samples", o->search.samples, "Rollouts a search")->capture_default_str();
  app->add_option("--workers", o->search.workers,
                  "Workers that share each search, inside this process (the rollouts are of all)")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app->add_option("--depth", o->search.depth, "Actions to look ahead; the plan's rest limits it")
      ->check(CLI::Range(1, 32))
      ->capture_default_str();
  app->add_option("--rule", o->search.rule, "Selection rule")->capture_default_str();
  app->add_option("--v-failed", o->search.v_failed,
                  "A future whose V falls below this on the way is given up")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app->add_option("--retries", o->retries,
                  "Times a plan that is lost may be begun anew, where the task allows it")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  app->add_option(
         "--surprise", o->surprise,
         "A plan is lost where a patch of the picture differs more than this from what was "
         "imagined")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app->add_option("--threshold", o->threshold,
                  "Plan score below which to refuse; negative: the weights' own")
      ->capture_default_str();
  app->add_option(
         "--rows", o->rows,
         "Which rows to run, the planner always among them; samples=N is the planner with N "
         "rollouts a search")
      ->delimiter(',');
  app->add_flag("--calibrate", o->calibrate,
                "Find the refusal threshold on calibration scenes (from 1500000) and store it in "
                "the weights; with --goal it is only told");
  AddPromiseOptions(app, &o->promise);
  AddShiftOptions(app, &o->shift);
  app->add_option("--jobs", o->jobs, "Processes")->check(CLI::Range(1, 64))->capture_default_str();
  app->add_option("--videos", o->videos,
                  "A folder for a video of each scene as the planner carried it out");
  app->add_option("--json", o->json_file, "Also write the figures and a record a scene here");
}

// N of a row "samples=N".
std::optional<int> SamplesOf(const std::string& row) {
  const std::string prefix = "samples=";
  if (row.rfind(prefix, 0) != 0) return std::nullopt;
  const std::string digits = row.substr(prefix.size());
  const bool number = !digits.empty() && digits.size() < 7 &&
                      digits.find_first_not_of("0123456789") == std::string::npos;
  if (!number || std::stoi(digits) < 1)
    throw std::invalid_argument("row '" + row + "': give samples=1 to samples=999999");
  return std::stoi(digits);
}

// Everything one process needs to evaluate scenes.
class Bench {
 public:
  explicit Bench(const Options& options)
      : options_(options),
        task_(sim::MakeTask(options.task, options.world)),
        engine_(model::LoadSearchEngine(options.weights, 1)),
        gauge_(model::NoveltyGauge::Load(options.weights)),
        cache_(sim::OracleKeyOf(*task_, options.world.objects)) {
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
      if (options.shift.open_loop) decider = MakeOpenLoop(std::move(decider));
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
    if (const std::optional<int> samples = SamplesOf(row)) {
      planner::SearchParameters other = search;
      other.samples = *samples;
      return Gated(MakeLearned(PlanBy::kSearch, engine_.get(), other, goal, retries, surprise));
    }
    if (row == "exhaustive")
      return Gated(
          MakeLearned(PlanBy::kExhaustive, engine_.get(), search, goal, retries, surprise));
    if (row == "greedy") return Gated(MakeLearned(PlanBy::kGreedy, engine_.get(), search, goal));
    if (row == "simulator_model") return MakeSimulatorModel(search, goal, retries);
    if (row == "random") return MakeRandom(goal);
    if (row == "nothing") return MakeNothing();
    throw std::logic_error("row " + row + " was checked before");
  }

  // Whatever the networks say of a picture that they cannot know means nothing.
  std::unique_ptr<Decider> Gated(std::unique_ptr<Decider> decider) {
    if (!gauge_ || options_.shift.novelty <= 0) return decider;
    return MakeNoveltyGate(std::move(decider), engine_.get(), *gauge_, options_.shift.novelty);
  }

  static json ToJson(const EpisodeRecord& record) {
    return {{"ending", ToString(record.ending)}, {"reason", record.reason},
            {"actions", record.actions},         {"score", record.first_score},
            {"scores", record.scores},           {"surprises", record.surprises},
            {"begun_anew", record.begun_anew},   {"carried_on", record.carried_on},
            {"evaluations", record.evaluations}, {"rollouts", record.rollouts},
            {"seconds", record.seconds_per_plan}};
  }

  Options options_;
  std::unique_ptr<sim::Task> task_;
  std::unique_ptr<model::Engine> engine_;
  std::optional<model::NoveltyGauge> gauge_;
  sim::OracleCache cache_;
  std::optional<sim::OracleCache> goal_cache_;
  std::vector<std::pair<std::string, std::unique_ptr<Decider>>> deciders_;
};

void RequireFolder(const std::string& folder) {
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw std::invalid_argument("--videos " + folder + ": " + error.message());
}

// Refuses what no process could do, before any starts. Throws std::invalid_argument,
// planner::GoalError or model::WeightsError.
void CheckInputs(const Options& options) {
  const std::vector<std::string> known = Options().rows;
  for (const std::string& row : options.rows) {
    if (std::find(known.begin(), known.end(), row) != known.end() || SamplesOf(row)) continue;
    throw std::invalid_argument(
        "unknown row '" + row +
        "'; known: planner, nothing, random, greedy, exhaustive, simulator_model, samples=N");
  }
  planner::MakeSelectionRule(options.search.rule, 1, 1);
  RulesOf(sim::MakeTask(options.task, options.world)->spec(), options.goal);
  RequireWeightsOf(options.task, options.weights);
  RequireFolder(options.videos);
  if (options.shift.novelty > 0 && !model::NoveltyGauge::Load(options.weights)) {
    std::cerr << "prospect-evaluate: " << options.weights
              << " holds nothing of known pictures: none is refused as unlike them "
                 "(--calibrate-novelty)\n";
  }
}

// Calibration looks at the planner's scores alone, on scenes kept for it, with nothing refused.
// What is stored with the weights is for the task's own goal; of another one the threshold is told.
void PrepareCalibration(Options* options) {
  if (options->wanted.total() > 0)
    throw std::invalid_argument("--calibrate wants scenes as they come: --scenes, not --solvable");
  options->rows = {"planner"};
  options->threshold = 0;
  options->shift = {};
  options->shift.novelty = 0;
  if (!options->promise.asked()) options->promise.refuse_at_most = 0.05;
  if (options->scenes > kMostCalibrationScenes)
    throw std::invalid_argument("a calibration keeps at most 10000 scenes");
  if (options->seed == 2'000'000) options->seed = 1'500'000;
  if (options->seed < 1'500'000 || options->seed + options->scenes > 2'000'000) {
    throw std::invalid_argument(
        "calibration scenes are 1500000 to 1999999; see --seed and --scenes");
  }
}

// What differs from the defaults.
std::string SceneOptions(const Options& options) {
  const sim::TaskOptions usual;
  std::string text;
  const auto add = [&text](const char* name, int value, int otherwise) {
    if (value != otherwise) text += std::string(" --") + name + " " + std::to_string(value);
  };
  add("objects", options.world.objects, usual.objects);
  add("legs", options.world.legs, usual.legs);
  add("tower", options.world.tower, usual.tower);
  if (!options.world.scene_file.empty()) text += " --scene-file " + options.world.scene_file;
  return text;
}

std::string CalibrationCommand(const Options& options) {
  std::ostringstream text;
  text << "./prospect evaluate --task " << options.task << SceneOptions(options)
       << " --calibrate --scenes " << options.scenes << " --seed " << options.seed << " --samples "
       << options.search.samples << " --v-failed " << options.search.v_failed;
  if (options.promise.refuse_at_most) text << " --alpha " << *options.promise.refuse_at_most;
  if (options.promise.fail_at_most)
    text << " --epsilon " << *options.promise.fail_at_most << " --delta " << options.promise.delta;
  return text.str();
}

model::SceneKind KindAsked(const Options& options) {
  const auto task = sim::MakeTask(options.task, options.world);
  task->Reset(options.seed);
  return KindOf(*task);
}

void Calibrate(const Options& options, const std::vector<SceneRecord>& scenes) {
  model::CalibrationSample sample = SampleFrom(scenes);
  sample.rule = options.search.rule;
  sample.parameters = CoveredParameters(options.search, KindAsked(options), options.retries);
  std::vector<std::string> words;
  const model::Calibration calibration =
      CalibrationFrom(sample, options.promise, CalibrationCommand(options), &words);
  for (const std::string& sentence : words) std::cout << sentence << "\n";
  if (!options.goal.empty()) {
    std::cout << model::CurveTable(sample) << "refusal threshold " << calibration.refusal_threshold
              << " from " << calibration.scenes << " scenes where "
              << planner::ToString(options.goal)
              << " is solvable; not stored, since the weights' own is for the task's goal: give it "
                 "as --refusal-threshold (evaluate: --threshold)\n";
    return;
  }
  model::StoreCalibration(options.weights, calibration);
  std::cout << model::CurveTable(sample) << "refusal threshold " << calibration.refusal_threshold
            << " from " << calibration.scenes << " solvable scenes, stored in " << options.weights
            << " with all " << sample.scenes.size() << " scenes\n";
}

// A promise without --calibrate: by what is stored with the weights.
void ChoosePromisedThreshold(Options* options) {
  if (options->calibrate || !options->promise.asked()) return;
  if (options->threshold >= 0)
    throw std::invalid_argument("--threshold is given: leave --alpha and --epsilon out");
  options->threshold = PromisedThresholdOf(options->weights, options->promise, KindAsked(*options));
  std::cout << "refusal threshold " << options->threshold << "\n";
}

// The scenes to run: so many in a row, or the first of each class.
std::vector<std::uint64_t> SeedsOf(const Options& options) {
  if (options.wanted.total() > 0) {
    return DrawScenes(options.wanted, options.seed, options.jobs, [&]() -> ClassOf {
      auto bench = std::make_shared<Bench>(options);
      return [bench](std::uint64_t seed) { return bench->ClassOf(seed); };
    });
  }
  std::vector<std::uint64_t> seeds(static_cast<std::size_t>(options.scenes));
  std::iota(seeds.begin(), seeds.end(), options.seed);
  return seeds;
}

void Tell(const Options& options, const SceneRuns& runs) {
  if (!options.goal.empty()) std::cout << "goal: " << planner::ToString(options.goal) << "\n";
  std::cout << Table(Summarise(runs.records, options.rows), options.rows)
            << runs.extent.Line("scenes");
  if (!options.calibrate) return;
  if (runs.extent.stopped()) {
    std::cout << "no calibration of so few scenes is stored\n";
    return;
  }
  Calibrate(options, runs.records);
}

// `not_covered`: what the weights were not calibrated for; empty: nothing.
void WriteReport(const Options& options, const SceneRuns& runs, const std::string& not_covered) {
  json summary = Summarise(runs.records, options.rows);
  summary["task"] = options.task;
  summary["goal"] = planner::ToString(options.goal);
  summary["first_seed"] = options.seed;
  summary["objects"] = options.world.objects;
  summary["legs"] = options.world.legs;
  summary["tower"] = options.world.tower;
  summary["scene_file"] = options.world.scene_file;
  summary["samples"] = options.search.samples;
  summary["factor"] = options.shift.factor;
  summary["strength"] = options.shift.strength;
  summary["open_loop"] = options.shift.open_loop;
  summary["novelty"] = options.shift.novelty;
  summary["threshold"] = options.threshold;
  summary["not_covered"] = not_covered;
  runs.extent.Put(&summary);
  summary["records"] = runs.records;
  base::WriteJsonFile(options.json_file, summary, 1);
}

int Main(int argc, char** argv) {
  Options options;
  options.search.samples = 30;
  CLI::App app(
      "Closed-loop evaluation on scenes never trained or tuned on, beside the oracle and plain "
      "baselines.");
  AddOptions(&app, &options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (app.count("--goal") > 0) options.goal = planner::ParseGoal(options.goal_text);
  if (options.calibrate) PrepareCalibration(&options);
  ApplyShift(options.shift, &options.world);
  if (options.rows.empty() || options.rows.front() != "planner")
    options.rows.insert(options.rows.begin(), "planner");
  CheckInputs(options);
  ChoosePromisedThreshold(&options);
  const std::string not_covered =
      options.calibrate ? ""
                        : HeedCoverage(options.weights, KindAsked(options), &options.threshold);
  SceneRuns runs = RunScenes(SeedsOf(options), options.jobs, [&]() -> SceneRun {
    auto bench = std::make_shared<Bench>(options);
    return [bench](std::uint64_t seed) { return bench->Run(seed); };
  });
  if (options.wanted.total() > 0) runs.extent.wanted = options.wanted.total();
  Tell(options, runs);
  if (!options.json_file.empty()) WriteReport(options, runs, not_covered);
  return runs.extent.exit_code();
}

}  // namespace
}  // namespace prospect::tools

int main(int argc, char** argv) {
  const auto run = [&] {
    try {
      return prospect::tools::Main(argc, argv);
    } catch (const prospect::planner::GoalError& error) {
      throw prospect::ExitError(prospect::kExitRefusal,
                                std::string("the goal cannot be brought about: ") + error.what());
    }
  };
  return prospect::RunMain(run, "prospect-evaluate", prospect::kExitWeights);
}

#include "cli/commands/evaluate.h"

#include <algorithm>

#include "cli/options/bus.h"
#include "cli/values.h"

namespace prospect::cli {
namespace {

void DefineGoal(CLI::App& app, std::string& goal) {
  app.add_option("--goal", goal,
                 "what is to hold in the end: \"on(red,blue)\", \"on(red,*)\", "
                 "\"visited(barrel,pylon)\"")
      ->default_str("the task's own")
      ->type_name("GOAL")
      ->check(Goal());
}

void DefineNovelty(CLI::App& app, double& novelty) {
  app.add_option("--novelty", novelty,
                 "first pictures with a smaller p-value are refused as unlike the known ones; 0: "
                 "none")
      ->type_name("P")
      ->check(Real(0, 1))
      ->capture_default_str();
}

void DefineThreshold(CLI::App& app, double& threshold) {
  app.add_option("--threshold", threshold, "plan score below which to refuse")
      ->default_str("the weights' own")
      ->type_name("X")
      ->check(Real(-1, 1));
}

void DefineUnseen(CLI::App& app, std::uint64_t& seed) {
  DefineSeed(app, seed,
             "first scene, since lower seeds are for training; models are compared and chosen on "
             "1000000 to 1499999, reported on 2000000 and up",
             kFirstUnseenSeed);
}

void DefineCalibrationSeed(CLI::App& app, std::uint64_t& seed) {
  app.add_option("--seed", seed, "first scene: calibration scenes are 1500000 to 1999999")
      ->type_name("N")
      ->transform(Whole(kFirstCalibrationSeed, kFirstReportedSeed - 1))
      ->capture_default_str();
}

bool IsAmong(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string CalibrationSeedDefect(std::uint64_t seed, int scenes) {
  if (seed + static_cast<std::uint64_t>(scenes) <= kFirstReportedSeed) return "";
  return "calibration scenes are 1500000 to 1999999; see --seed and --scenes";
}

void DefineRecorded(CLI::App& app, std::string& data, bool& all, const std::string& what) {
  CLI::Option* option = app.add_option("--data", data, what)->type_name("FILE");
  app.add_flag("--all-trials", all,
               "take all of its trials, of which none was trained on; else those of the valid and "
               "test parts")
      ->needs(option);
}

void DefineClasses(CLI::App& app, EvaluateOptions& options) {
  CLI::Option* scenes = app.get_option("--scenes");
  app.add_option("--solvable", options.solvable,
                 "instead of --scenes: the first so many solvable scenes, in seed order")
      ->type_name("N")
      ->transform(Whole(0, 100'000))
      ->excludes(scenes);
  app.add_option("--hopeless", options.hopeless, "the same of hopeless scenes")
      ->type_name("N")
      ->transform(Whole(0, 100'000))
      ->excludes(scenes);
}

}  // namespace

void Define(CLI::App& app, EvaluateOptions& options) {
  DefineTask(app, options.task, Tasks::kPlanned);
  DefineWeightsFile(app, options.weights);
  DefineScenes(app, options.scenes, "scenes, in seed order");
  DefineClasses(app, options);
  DefineUnseen(app, options.seed);
  DefineScene(app, options.scene);
  DefineGoal(app, options.goal);
  DefineSearch(app, options.search);
  DefineThreshold(app, options.threshold);
  DefinePromise(app, options.promise);
  DefineShift(app, options.shift);
  app.add_flag("--open-loop", options.open_loop,
               "carry the plan found from the first picture out as it is, without looking again");
  DefineNovelty(app, options.novelty);
  app.add_option(
         "--rows", options.rows,
         "which rows to run, the planner always among them; samples=N is the planner with N "
         "rollouts a search, simulator_model=N the simulator as its model with N runs an action")
      ->default_str("all")
      ->type_name("NAMES")
      ->delimiter(',');
  DefineJobs(app, options.jobs);
  app.add_option("--videos", options.videos,
                 "a folder for a video of each scene as the planner carried it out")
      ->type_name("DIR");
  DefineShard(app, options.shard);
  DefineReport(app, options.report);
}

std::string Defect(const EvaluateOptions& options) {
  if (options.promise.asked() && options.threshold >= 0)
    return "--threshold is given: leave --refuse-at-most and --fail-at-most out";
  if (options.shard.given() && options.solvable + options.hopeless > 0)
    return "--solvable and --hopeless count over all scenes: with --shard give --scenes";
  const std::string shard = ShardDefect(options.shard, options.report);
  return shard.empty() ? SceneDefect(options.scene, options.task) : shard;
}

void Define(CLI::App& app, EvaluatePlansOptions& options) {
  DefineTask(app, options.task, Tasks::kPlanned);
  DefineWeightsFile(app, options.weights);
  DefineScenes(app, options.scenes, "scenes, in seed order");
  DefineUnseen(app, options.seed);
  DefineScene(app, options.scene);
  app.add_option("--runs", options.runs,
                 "times that each plan is carried out, and as often again for the ceiling")
      ->type_name("N")
      ->transform(Whole(1, 1000))
      ->capture_default_str();
  app.add_option("--most-plans", options.most, "of more legal plans, so many are drawn")
      ->type_name("N")
      ->transform(Whole(2, 100'000))
      ->capture_default_str();
  DefineJobs(app, options.jobs);
  app.add_option("--outcomes", options.outcomes, "file that keeps how plans fared")
      ->default_str("under $PROSPECT_DATA/plans")
      ->type_name("FILE");
  DefineShard(app, options.shard);
  DefineReport(app, options.report);
}

std::string Defect(const EvaluatePlansOptions& options) {
  const std::string shard = ShardDefect(options.shard, options.report);
  return shard.empty() ? SceneDefect(options.scene, options.task) : shard;
}

void Define(CLI::App& app, EvaluateShiftsOptions& options) {
  DefineTask(app, options.task, Tasks::kPlanned);
  DefineWeightsFile(app, options.weights);
  app.add_option("--factors", options.factors, "what is shifted")
      ->type_name("NAMES")
      ->delimiter(',')
      ->check(OneOf(ShiftFactors()))
      ->capture_default_str();
  DefineScenes(app, options.scenes, "scenes of each point: all, in seed order");
  DefineUnseen(app, options.seed);
  DefineScene(app, options.scene);
  DefineSamples(app, options.samples);
  DefineNovelty(app, options.novelty);
  DefineThreshold(app, options.threshold);
  DefineJobs(app, options.jobs);
  DefineOut(app, options.out,
            "folder for shifts.png and the records, from which the same command goes on after an "
            "interruption")
      ->default_str("out/shifts-TASK");
  DefineReport(app, options.report);
}

std::string Defect(const EvaluateShiftsOptions& options) {
  return SceneDefect(options.scene, options.task);
}

void Define(CLI::App& app, CalibrateOptions& options) {
  DefineTask(app, options.task, Tasks::kAll);
  DefineWeightsFile(app, options.weights);
  DefineScenes(app, options.scenes, "scenes as they come", 1, 10'000);
  DefineCalibrationSeed(app, options.seed);
  DefineScene(app, options.scene);
  DefineGoal(app, options.goal);
  DefineSearch(app, options.search);
  DefinePromise(app, options.promise);
  DefineRecorded(app, options.data, options.all,
                 "recorded trials instead of scenes: threshold, promises and what known pictures "
                 "look like come from them");
  for (const char* name : {"--scenes", "--seed", "--goal"})
    app.get_option("--data")->excludes(app.get_option(name));
  app.add_option("--turns", options.turns,
                 "from now on these weights look at each picture in N of its eight turns and "
                 "mirrorings and say the mean (default as many as they do)")
      ->type_name("N")
      ->transform(Whole(1, 8));
  DefineJobs(app, options.jobs);
  DefineShard(app, options.shard);
  DefineReport(app, options.report);
}

std::string Defect(const CalibrateOptions& options) {
  if (options.shard.given() && (!options.data.empty() || options.turns > 0))
    return "--shard is for scenes, and for weights that stay as they are: leave --data and --turns "
           "out";
  if (!options.data.empty()) return "";
  const std::string shard = ShardDefect(options.shard, options.report);
  if (!shard.empty()) return shard;
  if (!IsAmong(TaskNames(Tasks::kPlanned), options.task))
    return "'" + options.task + "' has no built-in simulator: give --data, recorded trials";
  const std::string scenes = CalibrationSeedDefect(options.seed, options.scenes);
  return scenes.empty() ? SceneDefect(options.scene, options.task) : scenes;
}

void Define(CLI::App& app, EvaluateOnBusOptions& options) {
  options.episode.bus.log_level = "warn";
  DefineEpisode(app, options.episode);
  DefineRecovery(app, options.retries, options.surprise);
  DefineNoReset(app, options.reset);
  app.add_option("--episodes", options.episodes,
                 "episodes of each row, in all: those that --out holds already are not run again")
      ->type_name("N")
      ->transform(Whole(1, 1'000'000))
      ->capture_default_str();
  app.add_flag("--pause", options.pause,
               "wait for Enter before each episode, where a person sets the scene up");
  DefineAsk(app, options.ask);
  app.add_option("--rows", options.rows,
                 "whose episodes are run, on equal scenes where the robot heeds a seed")
      ->type_name("NAMES")
      ->delimiter(',')
      ->check(OneOf({"planner", "random", "greedy"}))
      ->capture_default_str();
  DefineProcess(app, options.episode.bus);
}

std::string Defect(const EvaluateOnBusOptions& options) {
  if (options.episode.out.empty()) return "--out is required: the folder of the records";
  return EpisodeDefect(options.episode);
}

void Define(CLI::App& app, EvaluateDataOptions& options) {
  DefineTask(app, options.task, Tasks::kAll);
  DefineRecorded(app, options.data, options.all, "recorded trials");
  app.get_option("--data")->required();
  DefineWeightsFile(app, options.weights);
  DefineReport(app, options.report);
}

std::string Defect(const EvaluateDataOptions&) { return ""; }

void Define(CLI::App& app, NoveltyOptions& options) {
  DefineTask(app, options.task, Tasks::kPlanned);
  DefineWeightsFile(app, options.weights);
  DefineScenes(app, options.scenes,
               "scenes: three fifths of them for the axes, the rest for the ranks", 100, 200'000);
  DefineCalibrationSeed(app, options.seed);
  app.add_option("--objects", options.objects,
                 "navigation: objects on the site; mixed: half of the scenes have 4, the others 4 "
                 "to 7")
      ->type_name("N")
      ->check(OneOf({"4", "5", "6", "7", "mixed"}))
      ->capture_default_str();
  app.add_option("--scene-file", options.scene_file,
                 "stacking: a scene of one's own, like config/scenes/stacking.yaml")
      ->type_name("FILE");
  DefineQuiet(app, options.quiet);
}

std::string Defect(const NoveltyOptions& options) {
  return CalibrationSeedDefect(options.seed, options.scenes);
}

void Define(CLI::App& app, RefusalsOptions& options) {
  CLI::Option* tasks =
      app.add_option("--task", options.tasks, "tasks whose bundled weights' samples are taken")
          ->default_str("all")
          ->type_name("NAMES")
          ->delimiter(',')
          ->check(OneOf(TaskNames(Tasks::kPlanned)));
  CLI::Option* weights = app.add_option("--weights", options.weights,
                                        "weights files whose calibration samples are taken")
                             ->type_name("FILES")
                             ->excludes(tasks);
  app.add_option("--report", options.reports,
                 "reports of evaluate --threshold 0 --json on calibration scenes, instead")
      ->type_name("FILES")
      ->excludes(tasks)
      ->excludes(weights);
  app.add_option("--splits", options.splits, "random halves")
      ->type_name("N")
      ->transform(Whole(1, 100'000))
      ->capture_default_str();
  DefineSeed(app, options.seed, "of the first split; the others count on");
  app.add_option("--refuse-at-most,--alpha", options.alphas,
                 "share of solvable scenes that may be refused; one for all, or one a file")
      ->type_name("SHARES")
      ->delimiter(',')
      ->check(Share())
      ->capture_default_str();
  app.add_option("--fail-at-most,--epsilon", options.epsilons,
                 "share of attempted scenes that may fail; one for all, or one a file")
      ->type_name("SHARES")
      ->delimiter(',')
      ->check(Share())
      ->capture_default_str();
  app.add_option("--delta", options.delta,
                 "--fail-at-most holds with probability 1 - delta over calibration samples")
      ->type_name("SHARE")
      ->check(Share())
      ->capture_default_str();
  app.add_option("--plot", options.plot, "also draw risk against coverage into this PNG")
      ->type_name("FILE");
  DefineReport(app, options.report);
}

}  // namespace prospect::cli

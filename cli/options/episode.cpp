#include "cli/options/episode.h"

#include "cli/options/rule.h"
#include "cli/options/search.h"
#include "cli/options/task.h"
#include "cli/values.h"

namespace prospect::cli {
namespace {

constexpr char kSearchGroup[] = "The search";
constexpr char kRefusalGroup[] = "When not to act";

void DefineSearch(CLI::App& app, EpisodeOptions& options) {
  DefineSamples(app, options.samples);
  app.get_option("--samples")->group(kSearchGroup);
  app.add_option("--depth", options.depth, "actions to look ahead")
      ->type_name("N")
      ->transform(Whole(0, 64))
      ->default_str("0: what remains of the plan")
      ->group(kSearchGroup);
  DefineRule(app, options.rule)->group(kSearchGroup);
}

}  // namespace

void DefineRefusal(CLI::App& app, RefusalOptions& options) {
  CLI::Option* threshold =
      app.add_option("--refusal-threshold", options.threshold, "plans that score less are refused")
          ->type_name("X")
          ->check(Real(0, 1))
          ->default_str("the weights' own");
  DefinePromise(app, options.promise);
  app.add_option("--novelty", options.novelty,
                 "first pictures with a smaller p-value are refused as unlike what the networks "
                 "were trained on; 0: none")
      ->type_name("P")
      ->check(Real(0, 1))
      ->capture_default_str();
  for (const char* name : {"--refuse-at-most", "--fail-at-most"})
    app.get_option(name)->excludes(threshold);
  for (const char* name :
       {"--refusal-threshold", "--refuse-at-most", "--fail-at-most", "--delta", "--novelty"})
    app.get_option(name)->group(kRefusalGroup);
}

void DefineWorkers(CLI::App& app, int& workers) {
  app.add_option("--workers", workers, "planner workers")
      ->type_name("N")
      ->transform(Whole(1, 1024))
      ->default_str("2; of services that are up: theirs")
      ->group(kSearchGroup);
}

void DefineEpisode(CLI::App& app, EpisodeOptions& options) {
  DefineTask(app, options.task, Tasks::kAll);
  app.add_option("--seed", options.seed, "the scene; from 1000000 on none was trained on")
      ->type_name("N")
      ->transform(Whole(0, kLargestSeed))
      ->capture_default_str();
  DefineSceneSize(app, options.scene);
  app.add_option("--goal", options.goal,
                 "what is to hold in the end: \"on(red,blue)\", \"on(red,*)\", "
                 "\"visited(barrel,pylon)\"")
      ->type_name("GOAL")
      ->check(Goal())
      ->default_str("the task's own");
  app.add_option("--out", options.out, "folder of results")
      ->type_name("DIR")
      ->envname("PROSPECT_OUT");
  app.add_flag("-v,--verbose", options.verbose, "log each search");
  DefineReport(app, options.report);
  DefineWorkers(app, options.workers);
  DefineSearch(app, options);
  DefineRefusal(app, options.refusal);
}

void DefineActing(CLI::App& app, ActingOptions& options) {
  app.add_option("--policy", options.policy,
                 "search, expert, collect (a random plan), or plan:0,2,1: these actions")
      ->type_name("NAME")
      ->check(Policy())
      ->capture_default_str();
  DefineRecovery(app, options.retries, options.surprise);
}

void DefineTrialLoop(CLI::App& app, TrialLoopOptions& options) {
  CLI::Option* episodes =
      app.add_option("--episodes", options.episodes,
                     "with --policy collect: so many trials, one scene after another, those that "
                     "--out counts already included")
          ->type_name("N")
          ->transform(Whole(1, 10'000'000))
          ->default_str("a single one");
  app.add_flag("--pause", options.pause,
               "wait for Enter before each of them, where a person sets the scene up")
      ->needs(episodes);
}

std::string TrialLoopDefect(const TrialLoopOptions& options, const ActingOptions& acting) {
  if (options.episodes == 0 || acting.policy == "collect") return "";
  return "--episodes collects trials: it needs --policy collect";
}

void DefineNoReset(CLI::App& app, bool& reset) {
  app.add_flag("!--no-reset", reset, "take the scene as it is, as on a robot");
}

void DefineAsk(CLI::App& app, bool& ask) {
  app.add_flag(
      "--ask", ask,
      "ask after an action whether it worked, where the robot cannot tell; recordings keep "
      "the answers");
}

void DefineWhatIf(CLI::App& app, std::string& what_if) {
  app.add_option("--what-if", what_if,
                 "tell what the model expects of this plan, too: \"align(green),grasp(green)\"")
      ->type_name("PLAN")
      ->check(PlanOfNames());
}

std::string EpisodeDefect(const EpisodeOptions& options) {
  return options.task.empty() ? "" : SceneDefect(options.scene, options.task);
}

}  // namespace prospect::cli

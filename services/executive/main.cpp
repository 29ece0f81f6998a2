// prospect-executive: one episode against services already up: look, search, act, look again; then
// tell what happened.

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>

#include "base/atomic_file.h"
#include "base/lock.h"
#include "base/run_main.h"
#include "services/common/common_options.h"
#include "services/common/signals.h"
#include "services/executive/conversation.h"
#include "services/executive/episode.h"
#include "services/executive/episode_video.h"
#include "services/executive/explanation_page.h"
#include "services/executive/explanation_pictures.h"
#include "services/executive/options.h"
#include "services/executive/plan_picture.h"
#include "services/executive/policy.h"
#include "services/executive/report.h"

namespace {

using namespace prospect;
using namespace prospect::services;

void AddSceneOptions(CLI::App& app, ExecutiveOptions& options) {
  app.add_option("--task", options.task, "refuse another than this; empty: whatever is up");
  app.add_option("--seed", options.seed, "scene")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--objects", options.objects, "objects on the site; 0: as the simulator stands")
      ->check(CLI::Range(0, 7))
      ->capture_default_str();
  app.add_option("--legs", options.legs, "actions in a complete plan; 0: as the simulator stands")
      ->check(CLI::Range(0, 32))
      ->capture_default_str();
  app.add_flag("!--no-reset", options.reset, "take the scene as it is, as on a robot");
  app.add_option("--world", options.world,
                 "the world_version that TASK must have, as prospect-simulator --check says it; "
                 "empty: any");
  app.add_option("--goal", options.goal,
                 "what is to hold in the end, such as \"on(red,blue)\", \"on(red,*)\" or "
                 "\"visited(barrel,pylon)\"; without: the task's own goal");
  app.add_option("--policy", options.policy,
                 "search; plan:0,2,1 carries these actions out; collect carries a random plan out")
      ->capture_default_str();
  app.add_option("--out", options.out,
                 "folder for result.json, explain.html, plan.png, episode.mp4; none: nothing is "
                 "written")
      ->envname("PROSPECT_OUT");
  auto* explain = app.add_flag("--explain-only", options.explain_only,
                               "search once, tell why, and carry nothing out");
  app.add_option("--what-if", options.what_if,
                 "with --explain-only: names of actions, as in \"align(green),grasp(green)\"; what "
                 "the model expects of that plan")
      ->needs(explain);
}

void AddPromiseOptions(CLI::App& app, prospect::model::Promise& promise) {
  const auto share = CLI::Range(0.0001, 0.9999);
  app.add_option("--refuse-at-most", promise.refuse_at_most,
                 "share of solvable scenes that may be refused: the threshold is chosen so, by the "
                 "weights' calibration")
      ->check(share)
      ->excludes("--refusal-threshold");
  app.add_option("--fail-at-most", promise.fail_at_most,
                 "share of attempted scenes that may fail: the threshold is chosen so; with both, "
                 "this one is kept where they exclude each other")
      ->check(share)
      ->excludes("--refusal-threshold");
  app.add_option("--delta", promise.delta,
                 "--fail-at-most holds with probability 1 - delta over calibrations")
      ->check(share)
      ->capture_default_str();
}

void AddSearchOptions(CLI::App& app, ExecutiveOptions& options) {
  auto& search = options.search;
  app.add_option("--samples", search.samples, "rollouts a search, over all workers")
      ->check(CLI::Range(1, 100000000))
      ->capture_default_str();
  app.add_option("--depth", search.depth, "actions to look ahead; 0: what remains of the plan")
      ->check(CLI::Range(0, 32))
      ->capture_default_str();
  app.add_option("--rule", search.rule, "selection rule")
      ->check(CLI::IsMember({"paper", "puct", "puct-virtual-loss", "random"}))
      ->capture_default_str();
  app.add_option("--c", search.c, "exploration constant of the paper's rule")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--c-done", search.c_done, "f below it: the action failed")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--v-failed", search.v_failed, "V below it: not followed further")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--p-min", search.p_min, "p below it: the action cannot follow")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--search-seed", search.seed, "breaks ties")->capture_default_str();
  app.add_option("--refusal-threshold", options.refusal_threshold,
                 "plans that score less are refused; -1: the weights' own")
      ->check(CLI::Range(-1.0, 1.0))
      ->capture_default_str();
  app.add_option("--retries", options.retries,
                 "times a plan that is lost may be begun anew, where the task allows it")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  AddPromiseOptions(app, options.promise);
  app.add_option("--novelty", options.novelty,
                 "first pictures with a smaller p-value are refused as unlike what the networks "
                 "were trained on; 0: none")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--surprise", options.surprise,
                 "a plan is lost where a patch of the picture differs more than this from what was "
                 "imagined")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--leaves", options.leaves, "evaluations a worker may have in flight")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_flag("!--no-sharing", options.sharing, "workers search apart; for comparison");
  app.add_option("--budget-ms", options.budget_ms, "time for one search; -1: none")
      ->check(CLI::Range(-1, 86400000))
      ->capture_default_str();
}

void AddServiceOptions(CLI::App& app, ExecutiveOptions& options) {
  app.add_option("--workers", options.workers, "planner workers to wait for")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--weights-hash", options.weights_hash,
                 "16 hexadecimal digits; empty: what the first server holds");
  app.add_option("--services-timeout-ms", options.services_timeout_ms,
                 "how long to wait for services")
      ->check(CLI::Range(0, 3600000))
      ->capture_default_str();
  app.add_option("--scene-timeout-ms", options.scene_timeout_ms,
                 "ms to wait for the scene to stand before the camera")
      ->check(CLI::Range(0, 3600000))
      ->capture_default_str();
}

// Empty: none was given, or it can be read.
std::string GoalDefect(const CLI::App& app, const std::string& goal) try {
  if (app.count("--goal") > 0) prospect::planner::ParseGoal(goal);
  return "";
} catch (const std::invalid_argument& error) {
  return error.what();
}

ExitCode CodeOf(const EpisodeRecord& record) {
  if (record.outcome == "solved" || record.outcome == "explained") return kExitSuccess;
  return record.outcome == "refused" ? kExitRefusal : kExitTaskFailure;
}

void WriteExplanation(const EpisodeRecord& record, const std::string& out) {
  if (!record.explanation) return;
  prospect::base::WriteFile(out + "/explain.html", ExplanationPage(*record.explanation));
  WriteExplanationPictures(*record.explanation, out);
}

void WriteFiles(const EpisodeRecord& record, const std::string& out, ExitCode code) {
  if (out.empty()) return;
  try {
    prospect::base::WriteFile(out + "/result.json", ResultJson(record, code));
    if (record.first.empty()) return;  // it ended before the camera looked
    WriteExplanation(record, out);
    if (record.outcome == "explained") return;  // nothing was carried out
    WritePlanPicture(record, out + "/plan.png");
    WriteEpisodeVideo(record, out + "/episode.mp4");
  } catch (const std::exception& error) {
    throw ExitError(kExitDisk, error.what());
  }
}

void Tell(const EpisodeRecord& record, const ExecutiveOptions& options, ExitCode code) {
  if (options.explain_only && record.explanation) {
    std::cout << ExplanationText(*record.explanation) << std::flush;
  } else if (!record.first.empty()) {
    std::cout << PlanTable(record) << std::flush;
  }
  WriteFiles(record, options.out, code);
}

// As far as it came, so that result.json is never that of another episode.
[[noreturn]] void EndStopped(Episode& episode, const ExecutiveOptions& options,
                             const ExitError& error) {
  try {
    Tell(episode.Stopped(error.what()), options, error.code());
  } catch (const std::exception& another) {
    spdlog::error("{}", another.what());
  }
  throw error;
}

// Whatever ends an episode, its files are written and the exit status is a documented one.
int RunEpisode(Conversation& talk, const ExecutiveOptions& options) {
  Episode episode(talk, options, [](const std::string& line) { std::cout << line << std::endl; });
  EpisodeRecord record;
  try {
    record = episode.Run();
  } catch (const ExitError& error) {
    EndStopped(episode, options, error);
  } catch (const std::exception& error) {
    EndStopped(episode, options, ExitError(kExitTaskFailure, error.what()));
  }
  Tell(record, options, CodeOf(record));
  return CodeOf(record);
}

int Run(int argc, char** argv) {
  CLI::App app("Executive: one episode against services already up");
  CommonOptions common;
  common.log_level = "warn";  // people want the progress and the table
  bool verbose = false;
  ExecutiveOptions options;
  options.search.samples = 30;
  options.search.depth = 0;
  AddCommonOptions(app, common);
  app.add_flag("-v,--verbose", verbose, "log each search, as --log-level info does");
  AddSceneOptions(app, options);
  AddSearchOptions(app, options);
  AddServiceOptions(app, options);
  try {
    app.parse(argc, argv);
    const std::string defect = PolicyDefect(options.policy);
    if (!defect.empty()) throw CLI::ValidationError("--policy", defect);
    const std::string no_goal = GoalDefect(app, options.goal);
    if (!no_goal.empty()) throw CLI::ValidationError("--goal", no_goal);
    if (options.explain_only && options.policy != "search")
      throw CLI::ValidationError("--explain-only", "needs --policy search");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  if (verbose && app.count("--log-level") == 0) common.log_level = "info";
  ApplyCommonOptions(common, "executive");
  std::optional<prospect::base::Lock> own;  // two episodes would mix their files
  if (!options.out.empty()) own = prospect::base::LockFolder(options.out);

  Bus bus(common.bus);
  Conversation talk(bus);
  talk.monitor().RequireOwnBus();
  return RunEpisode(talk, options);
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/fwd.h"
#include "cli/options/bus.h"
#include "cli/options/promise.h"
#include "cli/options/report.h"
#include "cli/options/scene.h"

namespace prospect::cli {

/// What may be asked of plans before anything is done; docs/trust.md says what each means.
struct RefusalOptions {
  std::optional<double> threshold;  ///< plans that score less are refused
  PromiseOptions promise;
  double novelty = 0.01;  ///< smallest p-value of a first picture; 0: any picture
};

/// Adds --refusal-threshold, --refuse-at-most, --fail-at-most, --delta and --novelty.
void DefineRefusal(CLI::App& app, RefusalOptions& options);

/// What may be asked of one episode. The commands that begin one (demo, explain, run) have them,
/// and so has prospect-executive, which gets them as they were typed.
struct EpisodeOptions {
  BusOptions bus;
  std::string task;  ///< empty: what is up, or the default
  std::int64_t seed = 2'000'000;
  SceneOptions scene;         ///< its size only
  std::string goal;           ///< as planner::ParseGoal reads it; empty: the task's own
  int workers = 0;            ///< planner workers; 0: what is up, or two
  std::int64_t samples = 30;  ///< rollouts a search
  std::string rule;  ///< of planner/selection_rule.h; empty: as the weights were calibrated
  int depth = 0;     ///< actions to look ahead; 0: what remains of the plan
  RefusalOptions refusal;
  bool verbose = false;
  std::string out;  ///< folder of results; empty: the command's own
  ReportOptions report;
};

/// How the plan is carried out.
struct ActingOptions {
  std::string policy = "search";   ///< or expert, collect, plan:A,B,...
  int retries = 1;                 ///< times a lost plan may be begun anew
  std::optional<double> surprise;  ///< it is lost where a patch differs more; left out: 0.3
};

/// Trials for training, one after another.
struct TrialLoopOptions {
  std::int64_t episodes = 0;  ///< in all, those of earlier calls too; 0: a single episode
  bool pause = false;         ///< before each, until Enter is typed
};

void DefineEpisode(CLI::App& app, EpisodeOptions& options);

/// Adds --policy, --retries and --surprise.
void DefineActing(CLI::App& app, ActingOptions& options);

/// Adds --episodes and --pause.
void DefineTrialLoop(CLI::App& app, TrialLoopOptions& options);
std::string TrialLoopDefect(const TrialLoopOptions& options, const ActingOptions& acting);

/// Adds --workers.
void DefineWorkers(CLI::App& app, int& workers);

/// Adds --no-reset, which clears `reset`.
void DefineNoReset(CLI::App& app, bool& reset);

/// Adds --ask.
void DefineAsk(CLI::App& app, bool& ask);

/// Adds --what-if.
void DefineWhatIf(CLI::App& app, std::string& what_if);

/// What is wrong with the options taken together; empty: nothing.
std::string EpisodeDefect(const EpisodeOptions& options);

}  // namespace prospect::cli

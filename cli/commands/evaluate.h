#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/fwd.h"
#include "cli/options/common.h"
#include "cli/options/episode.h"
#include "cli/options/promise.h"
#include "cli/options/report.h"
#include "cli/options/scene.h"
#include "cli/options/search.h"
#include "cli/options/shard.h"
#include "cli/options/shift.h"
#include "cli/options/task.h"
#include "cli/options/weights.h"

/// `prospect evaluate` and its subcommands: what networks and planner do on scenes that nothing was
/// trained or tuned on, without a bus.
namespace prospect::cli {

/// Closed loops beside the oracle's verdict and plain baselines.
struct EvaluateOptions {
  std::string task = DefaultTask();
  std::string weights;  ///< as WeightsFile()
  int scenes = 100;     ///< in seed order; unused where solvable or hopeless is set
  int solvable = 0;     ///< instead: the first so many solvable scenes
  int hopeless = 0;     ///< and hopeless ones
  std::uint64_t seed = kFirstReportedSeed;  ///< first scene
  SceneOptions scene;
  std::string goal;  ///< of every row and the oracle; empty: the task's own
  SearchOptions search;
  double threshold = -1;  ///< plan score below which to refuse; negative: the weights' own
  PromiseOptions promise;
  ShiftOptions shift;
  bool open_loop = false;  ///< the first plan is carried out as it is
  double novelty = 0.01;   ///< first pictures with a smaller p-value are refused; 0: none
  std::vector<std::string> rows = {"planner", "nothing",    "random",
                                   "greedy",  "exhaustive", "simulator_model"};
  int jobs = 2;
  std::string videos;  ///< folder for a video a scene; empty: none
  ShardOptions shard;
  ReportOptions report;
};

/// Which plans work: all plans of unseen scenes, scored, and each carried out many times.
struct EvaluatePlansOptions {
  std::string task = DefaultTask();
  std::string weights;
  int scenes = 20;
  std::uint64_t seed = kFirstReportedSeed;
  SceneOptions scene;
  int runs = 10;  ///< of each plan, and as many again for the ceiling
  int most = 50;  ///< of more legal plans, so many are drawn
  int jobs = 2;
  std::string outcomes;  ///< file that keeps how plans fared; empty: under $PROSPECT_DATA/plans
  ShardOptions shard;
  ReportOptions report;
};

/// Open loop with pictures unlike those of trials.
struct EvaluateShiftsOptions {
  std::string task = DefaultTask();
  std::string weights;
  std::vector<std::string> factors = ShiftFactors();
  int scenes = 100;  ///< of each point: all, in seed order
  std::uint64_t seed = 2'000'300;
  SceneOptions scene;
  std::int64_t samples = 30;
  double novelty = 0.01;
  double threshold = -1;
  int jobs = 2;
  std::string out;  ///< folder for shifts.png and the records; empty: out/shifts-TASK
  ReportOptions report;
};

/// Finds the refusal threshold on scenes kept for it, and stores it in the weights.
struct CalibrateOptions {
  std::string task = DefaultTask();
  std::string weights;
  int scenes = 100;                            ///< a calibration keeps at most 10000
  std::uint64_t seed = kFirstCalibrationSeed;  ///< first scene
  SceneOptions scene;
  std::string goal;  ///< its threshold is told and not stored; empty: the task's own
  SearchOptions search;
  PromiseOptions promise;  ///< nothing asked: refuse at most 0.05
  std::string data;        ///< recorded trials instead of scenes; empty: scenes
  bool all = false;        ///< of them all, as EvaluateDataOptions
  int turns = 0;  ///< the weights then look at each picture in so many turns; 0: as they do
  int jobs = 2;
  ShardOptions shard;
  ReportOptions report;
};

/// Stores in the weights what the first pictures of known scenes look like to them.
struct NoveltyOptions {
  std::string task = DefaultTask();
  std::string weights;
  int scenes = 5000;  ///< three fifths for the axes, the rest for the ranks
  std::uint64_t seed = kFirstCalibrationSeed;  ///< first scene
  std::string objects = "mixed";               ///< navigation: as trials are made
  std::string scene_file;                      ///< stacking: a scene of one's own
  bool quiet = false;
};

/// Closed loops with whatever is on the bus: a simulator, or a robot.
struct EvaluateOnBusOptions {
  EpisodeOptions episode;          ///< seed: the first scene; out: folder of the records
  int retries = 1;                 ///< of the planner's row
  std::optional<double> surprise;  ///< left out: as everywhere
  bool reset = true;               ///< false: scenes are taken as they stand
  int episodes = 60;               ///< scenes: each row has so many episodes
  bool pause = false;              ///< before each episode, until Enter is typed
  bool ask = false;                ///< whether an action worked, where the robot cannot tell
  std::vector<std::string> rows = {"planner", "random", "greedy"};
};

/// What the networks say of recorded trials that they were not trained on, beside what came of
/// them.
struct EvaluateDataOptions {
  std::string task = DefaultTask();
  std::string data;     ///< data set
  std::string weights;  ///< as WeightsFile()
  bool all = false;     ///< all trials, not only those of the parts that nothing is trained on
  ReportOptions report;
};

/// Whether the promises about refusals hold over random halves of calibration scenes.
struct RefusalsOptions {
  std::vector<std::string> tasks;    ///< whose bundled samples are taken; all empty: both planned
  std::vector<std::string> weights;  ///< files whose samples are taken
  std::vector<std::string> reports;  ///< of evaluate --threshold 0 --json, instead
  int splits = 20;                   ///< random halves
  std::uint64_t seed = 0;            ///< of the first split; the others count on
  std::vector<double> alphas = {0.05}, epsilons = {0.1};  ///< one for all, or one a file
  double delta = 0.1;
  std::string plot;  ///< PNG with risk against coverage; empty: none
  ReportOptions report;
};

void Define(CLI::App& app, EvaluateOptions& options);
void Define(CLI::App& app, EvaluatePlansOptions& options);
void Define(CLI::App& app, EvaluateShiftsOptions& options);
void Define(CLI::App& app, CalibrateOptions& options);
void Define(CLI::App& app, EvaluateOnBusOptions& options);
void Define(CLI::App& app, EvaluateDataOptions& options);
void Define(CLI::App& app, NoveltyOptions& options);
void Define(CLI::App& app, RefusalsOptions& options);
std::string Defect(const EvaluateOptions& options);
std::string Defect(const EvaluatePlansOptions& options);
std::string Defect(const EvaluateShiftsOptions& options);
std::string Defect(const CalibrateOptions& options);
std::string Defect(const NoveltyOptions& options);
std::string Defect(const EvaluateOnBusOptions& options);
std::string Defect(const EvaluateDataOptions& options);

}  // namespace prospect::cli

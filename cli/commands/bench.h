#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/fwd.h"
#include "cli/options/report.h"
#include "cli/options/task.h"

/// `prospect bench`: how fast parts are, and what more of them give.
namespace prospect::cli {

/// Searches over a bus of its own with the real programs, for growing numbers of workers.
struct BenchSearchOptions {
  std::vector<int> workers = {1, 2, 4, 8, 16};
  std::int64_t samples = 800;  ///< rollouts a search, of all workers together
  int seeds = 10;              ///< searches a number of workers, each on a tree of its own
  std::int64_t first_seed = 0;
  std::string rule = "paper";
  std::vector<int> leaves = {
      1};               ///< evaluations a worker keeps in flight: one for all, or one each
  int plan_length = 6;  ///< actions; scripted-tree has its own
  bool sharing = true;  ///< off: workers search apart
  bool prune = true;    ///< off: f, V and p cut nothing off, so that any network's tree is full
  std::string weights = "scripted-tree";  ///< as prospect-model-server's
  std::string fixed_cost = "4,0.02";  ///< A,B: a batch takes A ms + B ms a row; "none": as it does
  int max_batch = 16;                 ///< paths
  int threads = 2;                    ///< of the networks
  int servers = 1;                    ///< side by side
  bool engine_loop = false;           ///< beside each row the engine's own speed
  std::string bus;                    ///< LCM URL; empty: one of its own
  std::string logs;                   ///< folder of the services' logs; empty: a temporary one
  std::string csv, plot;              ///< files; empty: none
  ReportOptions report;
};

/// Workers around one batching server on a virtual clock (tools/bench/simulated_bus.h).
struct BenchSimulatedOptions {
  std::string rule = "paper";
  std::vector<int> workers = {1, 2, 4, 8, 16};
  std::vector<std::string> arms;  ///< tools/bench/simulated_arms.h; empty: one a number of workers
  std::int64_t samples = 800;     ///< rollouts of all workers together
  int seeds = 20;                 ///< trees for each arm
  int first_seed = 0;
  int threads = 1;  ///< trees searched at once
  int leaves = 2;   ///< rollouts a worker keeps in flight
  std::string csv;  ///< file; empty: none
  ReportOptions report;
};

/// Selection and backup, microseconds a rollout on one core, without the model's own time.
struct BenchOverheadOptions {
  std::string rule = "paper";
  std::int64_t rollouts = 20'000;
  int depth = 10;
  ReportOptions report;
};

/// How fast each world runs on one core, and where its time goes.
struct BenchSimOptions {
  std::vector<std::string> tasks = TaskNames(Tasks::kSimulated);
  int trials = 20;         ///< random ones, of each task
  std::uint64_t seed = 0;  ///< of the first
  ReportOptions report;
};

/// How surely stacking's controllers pick a block up and put it down where nothing is in the way.
struct BenchPicksOptions {
  int scenes = 500;                    ///< with a pair of blocks far from the obstacle
  std::uint64_t seed = 1'000'000;      ///< where the search for such scenes begins
  double clearance = 0.20;             ///< m between the obstacle and both blocks and their line
  std::vector<double> noise = {0, 1};  ///< scales of the execution noise; 1: the scene file's
  int jobs = 2;
  ReportOptions report;
};

/// How fast training's stages run here, against the machine's matrix products.
struct BenchTrainOptions {
  std::string task = DefaultTask();  ///< its default configuration
  std::string device = "cpu";        ///< or "cuda"
  std::string precision = "auto";    ///< as train's
  int threads = 2;
  double seconds = 5;  ///< about so long each stage is measured
  ReportOptions report;
};

/// How fast the engine answers on one core, beside libtorch's.
struct BenchEngineOptions {
  std::string task = DefaultTask();
  std::string weights;                        ///< as WeightsFile()
  std::vector<int> batches = {1, 4, 16, 64};  ///< rows a question
  int pairs = 7;     ///< measurements of each, taken in turns; medians are told
  int scenes = 200;  ///< on which the answers of both engines are compared
  ReportOptions report;
};

void Define(CLI::App& app, BenchSearchOptions& options);
void Define(CLI::App& app, BenchSimulatedOptions& options);
void Define(CLI::App& app, BenchOverheadOptions& options);
void Define(CLI::App& app, BenchSimOptions& options);
void Define(CLI::App& app, BenchPicksOptions& options);
void Define(CLI::App& app, BenchTrainOptions& options);
void Define(CLI::App& app, BenchEngineOptions& options);
std::string Defect(const BenchSearchOptions& options);

}  // namespace prospect::cli

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/fwd.h"
#include "cli/options/report.h"
#include "cli/options/task.h"

namespace prospect::cli {

/// Trains the networks of a task from a data set (docs/training.md).
struct TrainOptions {
  std::string task = DefaultTask();
  std::string data;                  ///< made by collect (HDF5)
  std::string out;                   ///< folder for checkpoints, caches, weights and curves.csv
  std::int64_t iterations = 0;       ///< of T, the other stages in proportion; 0: the task's own
  double minutes = 0;                ///< instead: of all stages' iterations together; 0: not asked
  std::string variant;               ///< of the paper's comparison; empty: none
  std::string recipe;                ///< file of runs, one after the other; empty: one run
  std::string sweep;                 ///< file of runs, of which `index` is trained; empty: none
  int index = 0;                     ///< from 1
  bool paper = false;                ///< leave all steps beyond the paper out
  std::vector<std::string> without;  ///< leave these out
  bool finetune = false;             ///< encoder and decoder learn on with T
  std::string device = "cpu";        ///< or "cuda"
  std::string from;                  ///< begin from these weights; empty: from random ones
  std::vector<std::string> fresh;    ///< stages whose networks are random all the same
  std::int64_t seed = -1;            ///< of weights, batches and dropout; -1: the task's own
  std::string config;                ///< JSON with what to change; empty: nothing
  std::string precision;             ///< "float32", "mixed" or "auto"; empty: the task's own
  std::string labels;                ///< "paper" or "authors"; empty: the task's own
  int threads = 2;                   ///< of the CPU
  std::vector<std::string> stages;   ///< only these; empty: all
  std::string score;                 ///< weights to score; nothing is trained; empty: train
  std::string bundle;                ///< folder for a copy of the weights without C; empty: none
  bool print_config = false;         ///< print the configuration and stop
  ReportOptions report;
  /// All that was typed, apart from --sweep, --index, --out and what becomes of the report.
  std::vector<std::string> asked;
};

void Define(CLI::App& app, TrainOptions& options);
std::string Defect(const TrainOptions& options);

/// As --variant and --without take them (model/training/variants.h, recipe.h).
std::vector<std::string> VariantNames();
std::vector<std::string> RecipeStepNames();

}  // namespace prospect::cli

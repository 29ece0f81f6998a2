#pragma once

#include <string>

#include "cli/fwd.h"
#include "cli/options/report.h"
#include "cli/options/task.h"

namespace prospect::cli {

/// Pictures and labels after one and two actions: a table of trained variants.
struct TablesOptions {
  std::string task = DefaultTask();
  std::string data;         ///< made by collect (HDF5)
  std::string models;       ///< folder with VARIANT/TASK.safetensors; empty: none
  std::string weights;      ///< a file as one more row; empty: none
  std::string judge;        ///< classifiers whose second reads the labels; empty: the first row's
  std::string out;          ///< folder for tables.md and tables.csv
  int every = 1;            ///< of the frames during actions, every so-many-th
  int trials = 0;           ///< at most so many test trials, evenly spread; 0: all
  bool paper_tail = false;  ///< keep frames of a trial's last action (tools/tables/examples.h)
  int threads = 2;          ///< of the CPU
  bool quiet = false;
};

void Define(CLI::App& app, TablesOptions& options);

}  // namespace prospect::cli

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/fwd.h"
#include "cli/options/report.h"

namespace prospect::cli {

struct DatasetInfoOptions {
  std::string file;  ///< the data set
  ReportOptions report;
};

struct DatasetPackOptions {
  std::vector<std::string> inputs;  ///< trial files, data sets, or folders of them
  std::string out;                  ///< the data set to write
  std::string split;                ///< only trials of this part: train, valid or test; empty: all
  int trials = 0;                   ///< only the first so many of them, by seed; 0: all
  bool quiet = false;
};

struct DatasetSheetOptions {
  std::string file;        ///< the data set
  std::string out;         ///< PNG
  int rows = 12;           ///< trials to show
  std::uint64_t seed = 0;  ///< which trials are drawn
  bool quiet = false;
};

/// Logs of the bus to a data set that trains the same networks as collected ones.
struct DatasetFromLogOptions {
  std::vector<std::string> logs;  ///< that lcm-logger wrote
  std::string out;                ///< the data set to write (HDF5)
  ReportOptions report;
};

/// Videos and transcriptions in the layout of JIGSAWS to a data set.
struct DatasetJigsawsOptions {
  std::string root;    ///< folder that holds the task's folder
  std::string folder;  ///< the task's folder as distributed, such as "Suturing"
  std::string out;     ///< the data set to write
  int every = 10;      ///< one frame in so many is kept, besides each gesture's first and the last
  int hold_out = 3;    ///< trials held out by a hash of their names, unless named or a user's
  std::vector<std::string> hold_out_trials;  ///< these are held out instead, such as "B001"
  std::string hold_out_user;                 ///< this user's are, such as "B"
  int valid = 3;                             ///< so many of the others only choose between settings
  bool quiet = false;
};

void Define(CLI::App& app, DatasetInfoOptions& options);
void Define(CLI::App& app, DatasetPackOptions& options);
void Define(CLI::App& app, DatasetSheetOptions& options);
void Define(CLI::App& app, DatasetFromLogOptions& options);
void Define(CLI::App& app, DatasetJigsawsOptions& options);

}  // namespace prospect::cli

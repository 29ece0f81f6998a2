#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/fwd.h"
#include "cli/options/report.h"

namespace prospect::cli {

struct DatasetInfoOptions {
  std::string file;  ///< the data set
  std::string task;  ///< NAME or FILE: whose actions they are; empty: the data say
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
  std::string task;        ///< NAME or FILE: whose actions they are; empty: the data say
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

/// Videos, and tables of what is done in them, to a data set.
struct DatasetFromVideoOptions {
  std::string folder;        ///< of videos and tables
  std::string task;          ///< NAME or FILE: whose actions they are
  std::string out;           ///< the data set to write
  std::optional<int> every;  ///< one frame in so many is kept; nothing: one a tick of the task
  std::vector<std::string> held_out;  ///< trials to test on; empty: a tenth, by a hash of names
  bool quiet = false;
};

/// Demonstrations in robomimic's layout to a data set.
struct DatasetFromRobomimicOptions {
  std::string file;      ///< demonstrations
  std::string task;      ///< NAME or FILE: whose actions they are
  std::string segments;  ///< CSV: which actions ran when
  std::string camera;    ///< name of its pictures; empty: the only ones
  std::string out;       ///< the data set to write
  int every = 1;         ///< one picture in so many is kept
  bool quiet = false;
};

/// A data set as robomimic reads one.
struct DatasetExportOptions {
  std::string file;       ///< the data set
  std::string out;        ///< the file to write
  bool next_obs = false;  ///< with each picture the one after it, too
  std::string segments;   ///< CSV to write: which actions ran when; empty: none
  bool quiet = false;
};

void Define(CLI::App& app, DatasetInfoOptions& options);
void Define(CLI::App& app, DatasetPackOptions& options);
void Define(CLI::App& app, DatasetSheetOptions& options);
void Define(CLI::App& app, DatasetFromLogOptions& options);
void Define(CLI::App& app, DatasetFromVideoOptions& options);
void Define(CLI::App& app, DatasetFromRobomimicOptions& options);
void Define(CLI::App& app, DatasetExportOptions& options);

}  // namespace prospect::cli

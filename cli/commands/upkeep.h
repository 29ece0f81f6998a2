#pragma once

#include <cstdint>
#include <string>

#include "cli/fwd.h"
#include "cli/options/bus.h"
#include "cli/options/report.h"

/// Commands that ask about or of the deployment that is up.
namespace prospect::cli {

struct DownOptions {
  std::string bus;
  ReportOptions report;
};
void Define(CLI::App& app, DownOptions& options);

struct KeyOptions {
  std::string bus;
  ReportOptions report;
};
void Define(CLI::App& app, KeyOptions& options);

struct ScaleOptions {
  std::string wish;  ///< "workers=N"
  std::string bus;
  ReportOptions report;

  int workers() const;  ///< 0 to 1024
};
void Define(CLI::App& app, ScaleOptions& options);

struct DoctorOptions {
  bool mend = false;  ///< runs the commands that mend, without asking
  std::string bus;
  ReportOptions report;
};
void Define(CLI::App& app, DoctorOptions& options);

struct StatusOptions {
  BusOptions bus;
  std::string services_file;  ///< a supervisor's services.json; empty: none is known
  double seconds = 1.2;       ///< a little more than the time between two signs of life
  bool watch = false;         ///< again and again
  ReportOptions report;
};
void Define(CLI::App& app, StatusOptions& options);

struct CheckRobotOptions {
  BusOptions bus;
  std::string task;  ///< NAME|FILE that it is to agree with; empty: none
  ReportOptions report;
};
void Define(CLI::App& app, CheckRobotOptions& options);

struct SpyOptions {
  BusOptions bus;
  double check = 0;  ///< seconds to listen without a window; 0: lcm-spy
  std::string jar;   ///< types for lcm-spy; empty: ours
  ReportOptions report;
};
void Define(CLI::App& app, SpyOptions& options);
std::string Defect(const SpyOptions& options);

struct RecordOptions {
  std::string file;
  bool overwrite = false;
  bool append = false;
  std::string channels;  ///< regular expression; empty: all
  std::string bus;
  bool quiet = false;
};
void Define(CLI::App& app, RecordOptions& options);

struct PredictOptions {
  BusOptions bus;
  std::string out;
  std::string actions;      ///< names; empty: the one under way, then each that may follow
  double truth = 0;         ///< seconds to wait for what really comes; 0: does not
  std::int64_t seed = -1;   ///< of the scene to wait for; -1: any
  bool from_start = false;  ///< waits until the next action begins
  int segment = 0;          ///< waits until this action of the episode begins, 0 the first
  int services_timeout_ms = 15000;
  int picture_timeout_ms = 60000;
  bool quiet = false;
};
void Define(CLI::App& app, PredictOptions& options);

/// Of commands that have no options.
struct NoOptions {};
void Define(CLI::App& app, NoOptions& options);

struct TestOptions {
  bool quick = false, asan = false, tsan = false, tidy = false;
};
void Define(CLI::App& app, TestOptions& options);

struct CompletionOptions {
  std::string shell;
};
void Define(CLI::App& app, CompletionOptions& options);

}  // namespace prospect::cli

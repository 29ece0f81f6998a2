#pragma once

#include <string>

#include "cli/fwd.h"
#include "cli/options/episode.h"
#include "cli/options/start.h"
#include "cli/options/task.h"

namespace prospect::cli {

struct DemoOptions {
  DemoOptions() { episode.task = DefaultTask(); }
  EpisodeOptions episode;
  ActingOptions acting;
  StartOptions start;
};
void Define(CLI::App& app, DemoOptions& options);
std::string Defect(const DemoOptions& options);

struct ExplainOptions {
  EpisodeOptions episode;
  StartOptions start;   ///< only with nothing up
  std::string what_if;  ///< names of actions; empty: none
  bool reset = true;    ///< false: the scene as it is
};
void Define(CLI::App& app, ExplainOptions& options);
std::string Defect(const ExplainOptions& options);

struct UpOptions {
  BusOptions bus;
  std::string task = DefaultTask();
  SceneOptions scene;
  int workers = -1;  ///< -1: two, or none where nothing is planned
  StartOptions start;
  std::string video;          ///< in the simulator's place
  std::string transcription;  ///< its gestures
  bool simulator = true;      ///< false: a robot takes its place
  bool console = false;       ///< with a page in the browser
  bool control = false;       ///< whose buttons may be pressed
  bool foreground = false;
  ReportOptions report;
};
void Define(CLI::App& app, UpOptions& options);
std::string Defect(const UpOptions& options);

struct RunOptions {
  EpisodeOptions episode;
  ActingOptions acting;
  TrialLoopOptions trials;
  std::string weights;  ///< that must be up; empty: whatever is
  bool reset = true;    ///< false: the scene as it is, as on a robot
  bool ask = false;     ///< whether an action worked, where the robot cannot tell
};
void Define(CLI::App& app, RunOptions& options);
std::string Defect(const RunOptions& options);

}  // namespace prospect::cli

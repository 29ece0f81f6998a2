#pragma once

#include <string>

#include "cli/fwd.h"
#include "cli/options/episode.h"

namespace prospect::cli {

/// What prospect-executive takes of the commands that start it (demo, explain, run), which hand on
/// what was typed. It is no command of its own.
struct ExecutiveOptions {
  EpisodeOptions episode;
  ActingOptions acting;
  TrialLoopOptions trials;
  bool reset = true;          ///< false: the scene as it is
  bool ask = false;           ///< whether an action worked, where the robot cannot tell
  std::string world;          ///< world_version that TASK must have; empty: any
  bool explain_only = false;  ///< searches once, tells why, and carries nothing out
  std::string what_if;        ///< with the former
};

void Define(CLI::App& app, ExecutiveOptions& options);
std::string Defect(const ExecutiveOptions& options);

}  // namespace prospect::cli

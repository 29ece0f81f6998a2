#pragma once

#include <string>

#include "cli/options/episode.h"
#include "cli/options/start.h"
#include "cli/run/deployment.h"

namespace prospect::cli {

/// Planner workers where nobody says how many.
inline constexpr int kUsualWorkers = 2;

/// What a deployment is started with.
struct Starting {
  std::string task;       ///< its name
  std::string task_file;  ///< by its whole path, where it is a file of one's own; else empty
  int workers = kUsualWorkers;
  std::string weights;  ///< file
  Words scene;          ///< arguments of the simulator, or of the player
  std::string chaos;
  bool open = false;
};

/// The number of workers that is meant: where none is asked for (0), kUsualWorkers, or none for
/// gestures, which are only predicted.
int WorkersOf(int wish, const std::string& task);

/// Of what a command was asked for. Sets the key in the environment, too.
/// @param searches false: nobody asks the networks @throws ExitError
Starting StartingOf(const EpisodeOptions& episode, const StartOptions& start,
                    const std::string& task, bool searches);

/// Arguments of prospect-supervisor, "--" and the scene's last. @param logs folder; empty: that of
/// its state
Words ArgumentsOf(const Starting& starting, const std::string& logs);

/// The programs that a deployment and an episode in it consist of.
Words DeployedPrograms();

}  // namespace prospect::cli

#pragma once

namespace prospect {

/// What a program's exit status means, the same for every program (docs/architecture.md). A shell
/// script or a robot's supervisor decides by these numbers, so they never change. They lie in
/// namespace prospect itself because every room says them.
enum ExitCode : int {
  kExitSuccess = 0,
  kExitUnexpected = 1,    ///< an error that nobody foresaw
  kExitUsage = 2,         ///< wrong options
  kExitRefusal = 3,       ///< the planner advises not to act; nothing was done
  kExitTaskFailure = 4,   ///< the task failed, or was given up after the first action
  kExitTolerance = 5,     ///< a measured figure lies outside its tolerance
  kExitWeights = 10,      ///< weights missing, damaged or for another task
  kExitBus = 11,          ///< no bus: bad URL, no multicast route
  kExitBusInUse = 12,     ///< another deployment lives on this bus
  kExitDisk = 13,         ///< a file could not be written
  kExitDataFile = 14,     ///< a data file is missing or damaged
  kExitServiceLost = 15,  ///< a service needed is not there or fell silent
  kExitTimeout = 16,      ///< nothing happened in time
  kExitInterrupted = 130  ///< SIGINT or SIGTERM
};

}  // namespace prospect

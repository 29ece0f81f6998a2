#pragma once

namespace prospect::services {

/// Most planner workers that one deployment may have.
inline constexpr int kMostWorkers = 1024;

/// The signal that carries a wished number of workers as its value. (Not a constant: the C library
/// takes the first real-time signals for itself.)
int ScaleSignal();

/// Whether the command line is one of those below.
bool IsCommand(int argc, char** argv);

/// Asks about or of the deployment of `--bus URL`, or the one whose state folder is `--state DIR`:
///   folder            prints its state folder; --private: makes a new one
///   join [wishes]     prints NAME=VALUE lines: state, deployment, key, task, workers, logs; 2 when
///                     it cannot do what is wished for, 15 when none is up
///   stop              stops it, and removes what one that crashed has left
///   scale N           so many planner workers
///   given-up          says which services it gave up and why; ends with the first one's status
/// A process is signalled only while it holds the deployment's lock. @return the exit status
/// @throws ExitError
int RunCommand(int argc, char** argv);

}  // namespace prospect::services

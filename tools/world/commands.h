#pragma once

#include "cli/commands/ceiling.h"
#include "cli/commands/oracle.h"
#include "cli/commands/takes.h"
#include "cli/commands/view.h"

namespace prospect::tools {

// What prospect-world carries out. Each returns the exit code; throws ExitError,
// std::invalid_argument.

/// What can be achieved in the scenes of a task: runs every legal plan in every scene and tells how
/// often random orders fail and why, and how many scenes are solvable, hopeless or doubtful.
int RunOracle(const cli::OracleOptions& options);

/// How well what V, f and T are asked can be known at all. Trials of a data set's test part are
/// carried out again up to a random moment and from there on many times: execution noise, and
/// actions that nobody has chosen yet, are what no picture tells.
int RunCeiling(const cli::CeilingOptions& options);

/// How far two takes of one action differ, from the same state with fresh noise: the floor of what
/// a prediction of one picture can reach in a world that does not repeat itself.
int RunTakes(const cli::TakesOptions& options);

int RunView(const cli::ViewOptions& options);

}  // namespace prospect::tools

#pragma once

#include <cstdint>
#include <string>

#include "model/engine.h"

namespace prospect::tools {

/// How far the answers of two engines with the same weights lie apart on scenes of a task.
struct EngineAgreement {
  int states = 0;      ///< imagined ones that were compared, each engine going on from its own
  double judged = 0;   ///< largest difference of any V, f, Q or p
  double state = 0;    ///< ... of a number of a hidden state
  double picture = 0;  ///< ... of a pixel, share of full scale
  int decisions = 0;   ///< scenes in which both looked for a plan; none where they do not judge
  int differing = 0;   ///< ... and found different ones
  double tie = 0;      ///< where they differ: largest difference of the two plans' scores, both
                       ///< by the reference
};

/// Compares `engine` with `reference` from the first pictures of `scenes` scenes of `task`, the
/// first of them `first_seed`: along a run of kRun random actions that may follow each other, and,
/// where the engines judge, by a search of kRollouts rollouts each. Pictures are painted after the
/// last action. Throws std::invalid_argument for a task without a simulator.
EngineAgreement Compare(model::Engine& engine, model::Engine& reference, const std::string& task,
                        std::uint64_t first_seed, int scenes);

}  // namespace prospect::tools

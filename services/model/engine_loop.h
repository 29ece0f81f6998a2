#pragma once

#include "model/engine.h"

namespace prospect::services {

/// Evaluations a second of the engine in a loop of its own, with nothing around it: batches of
/// floor(mean_batch) and one more row, mixed so that their mean is `mean_batch` (>= 1), for about
/// `seconds` after a short warm-up. Rows start from states that the engine itself imagined.
double EngineLoopRate(model::Engine& engine, double mean_batch, double seconds = 3);

}  // namespace prospect::services

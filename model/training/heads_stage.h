#pragma once

#include <memory>

#include "model/training/context.h"
#include "model/training/stage.h"

namespace prospect::model {

/// Trains V, Q, p and f (separate networks, one loop) on encodings of real frames, and on states
/// imagined by the frozen T along whole plans, in shares (1 - imagined_share) and imagined_share of
/// the loss. Labels (DESIGN §5):
///   V(h): did the trial succeed. f(h0, h, a): did the action succeed (its goal picture, or the
///   state imagined for it), 0 on frames at least 0.3 s before its end. p(a' | h0, h, a): may a'
///   follow (samples.h, MayFollow). Q(h0, h, a, a'): did the trial succeed, for the a' that was
///   carried out next; other actions carry no loss.
/// Binary cross-entropy without balancing: the outputs are to be probabilities.
std::unique_ptr<Stage> MakeHeadsStage(const TrainContext& context);

}  // namespace prospect::model

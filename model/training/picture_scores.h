#pragma once

#include <nlohmann/json.hpp>

#include "model/training/scored_split.h"

namespace prospect::model {

/// The "pictures" and "labels" scores of scores.h, on chains of one or two actions from the start
/// of (at most `most_chains`) segments of the part. Uses `threads` threads.
nlohmann::json ScorePictures(const ScoredSplit& split, const TrialFile& file,
                             std::size_t most_chains, int threads);

}  // namespace prospect::model

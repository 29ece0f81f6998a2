#pragma once

#include <cstdint>
#include <functional>

namespace prospect::model {

/// Calls work(begin, end) for consecutive pieces of 0..total of at most `piece` items, spread over
/// `threads` threads that each run libtorch single-threaded. What a piece computes must not depend
/// on others. Returns when all are done; the first exception is rethrown here.
void ParallelPieces(std::int64_t total, std::int64_t piece, int threads,
                    const std::function<void(std::int64_t begin, std::int64_t end)>& work);

}  // namespace prospect::model

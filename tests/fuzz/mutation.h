#pragma once

#include <random>
#include <vector>

#include "tests/fuzz/corpus.h"

namespace prospect::fuzz {

/// One of `corpus` after one to four changes: bytes flipped, numbers planted that break decoders,
/// parts cut out, repeated, or taken from another message of the corpus, the end cut or grown. The
/// fingerprint mostly stays. The same generator state gives the same payload.
/// @param corpus not empty
Bytes Mutate(const std::vector<Bytes>& corpus, std::mt19937_64& random);

}  // namespace prospect::fuzz

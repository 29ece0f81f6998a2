#pragma once

#include <cstdint>
#include <string>

#include "planner/search.h"

namespace prospect::services {

/// What a process knows of a search, as text that is the same byte for byte in every process that
/// knows the same: one line a visited path, in order of paths, with its visits, value sum and best
/// value over all writers, and its evaluation (fingerprint, V, f, Q and p, as hexadecimal floats).
/// In-flight visits are left out: they pass. Q and p are as they travel, in 16 bits.
std::string TableText(const planner::Search& search);

/// Hash of that text, for comparing across processes.
std::uint64_t TableHash(const planner::Search& search);

}  // namespace prospect::services

#pragma once

namespace prospect::base {

namespace internal {
inline bool quiet = false;
}

/// Whether this process keeps progress and what it finds to itself, as --quiet asks: errors and
/// warnings are told all the same. Set once, before any thread is made.
inline bool Quiet() { return internal::quiet; }
inline void SetQuiet(bool quiet) { internal::quiet = quiet; }

}  // namespace prospect::base

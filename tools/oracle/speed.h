#pragma once

#include <cstdint>

#include "sim/task.h"

namespace prospect::tools {

/// Simulated seconds of random trials from scene `seed` on, a second of processor time, their
/// set-up included: what one free core does. Takes half a second.
double TimesRealTime(sim::Task& task, std::uint64_t seed, bool with_camera);

}  // namespace prospect::tools

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/rollout.h"
#include "sim/task.h"

namespace prospect::report {

/// Carries `actions` out on scene `seed` and films it as people see it: an MP4 with a picture a
/// tick in real time, with a second of the beginning before and a second of the end after. Worlds
/// repeat bit for bit, so that what is shown of an episode is what happened.
/// @return what became of the actions. Throws base::DiskError where the video cannot be written.
sim::RolloutResult FilmPlan(sim::Task& task, std::uint64_t seed, const std::vector<int>& actions,
                            const std::string& path);

}  // namespace prospect::report

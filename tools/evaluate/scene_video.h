#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/task.h"
#include "tools/evaluate/episode.h"

namespace prospect::tools {

// FOLDER/SEED-ENDING.mp4: an episode as people see it, a picture a tick in real time, with a second
// of the beginning before and a second of the end after. The episode's actions are carried out once
// more on scene `seed`: worlds repeat bit for bit, so what is shown is what happened. Returns the
// video's path.
// Throws std::runtime_error when the folder or the video cannot be written; std::logic_error when
// the episode did not repeat.
std::string WriteSceneVideo(sim::Task& task, std::uint64_t seed, const EpisodeRecord& episode,
                            const std::string& folder);

}  // namespace prospect::tools

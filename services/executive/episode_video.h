#pragma once

#include <string>

#include "agent/record.h"

namespace prospect::services {

/// episode.mp4: every picture of the episode, enlarged, at its own pace. Nothing is written when no
/// picture was heard. Throws std::runtime_error when the file cannot be written.
void WriteEpisodeVideo(const agent::EpisodeRecord& record, const std::string& path);

}  // namespace prospect::services

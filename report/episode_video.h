#pragma once

#include <string>

#include "agent/record.h"

namespace prospect::report {

/// episode.mp4: every picture of the episode, enlarged, at its own pace. Nothing is written when no
/// picture was heard. Throws base::DiskError when the file cannot be written.
void WriteEpisodeVideo(const agent::EpisodeRecord& record, const std::string& path);

}  // namespace prospect::report

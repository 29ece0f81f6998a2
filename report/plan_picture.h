#pragma once

#include <string>

#include "agent/record.h"

namespace prospect::report {

/// plan.png: what was imagined beside what then happened, for a person who has not read the code. A
/// header with the verdict; columns, one a step, with the imagined picture above the observed one
/// and the step's figures, in bands of at most 1,900 pixels below each other; below, the first
/// actions that were not chosen and why.
/// Throws base::DiskError when the file cannot be written.
void WritePlanPicture(const agent::EpisodeRecord& record, const std::string& path);

}  // namespace prospect::report

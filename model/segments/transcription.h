#pragma once

#include <string>
#include <vector>

#include "model/segments/segmentation.h"

namespace prospect::model::segments {

/// Reads a transcription as JIGSAWS has them: a line "FIRST LAST ACTION" an action, frames from 1,
/// empty lines allowed; all have succeeded. @param names of the task's actions. Throws DataError,
/// naming file and line, on a file that cannot be read, a line of another form, and as InOrder.
Segmentation ReadTranscription(const std::string& path, const std::vector<std::string>& names);

}  // namespace prospect::model::segments

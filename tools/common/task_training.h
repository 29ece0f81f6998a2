#pragma once

#include <string>

#include "model/training/train_config.h"
#include "tasks/task_file.h"

namespace prospect::tools {

/// What a task is trained with where nobody says otherwise: its file's settings; without any, those
/// that fit its table and the data. @param data data set; empty: none yet. Throws
/// tasks::TaskFileError, with the line, where a setting is unknown or out of range, and
/// model::DataError.
model::TrainConfig TrainConfigOf(const tasks::TaskFile& task, const std::string& data = "");

}  // namespace prospect::tools

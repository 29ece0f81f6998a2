#pragma once

#include <string>

#include "model/dataset.h"
#include "tasks/task_file.h"

namespace prospect::tools {

/// In what a task file's table is another than the one that `trial` was recorded with, in words;
/// empty: in nothing.
std::string TableDifference(const tasks::TaskFile& task, const model::Trial& trial);

/// Throws model::DataError where the data were recorded with another table than `task` has. Data
/// without trials fit every table.
void RequireSameTable(const tasks::TaskFile& task, const model::TrialFile& data);

}  // namespace prospect::tools

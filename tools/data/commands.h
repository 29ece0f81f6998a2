#pragma once

#include "cli/commands/collect.h"
#include "cli/commands/dataset.h"
#include "cli/commands/merge.h"
#include "cli/commands/tasks.h"

namespace prospect::tools {

// What prospect-data carries out. Each returns the exit code; throws ExitError,
// std::invalid_argument.

/// Records random trials of a task as a data set. May be killed at any time; --resume goes on.
int RunCollect(const cli::CollectOptions& options);

int RunInfo(const cli::DatasetInfoOptions& options);
int RunPack(const cli::DatasetPackOptions& options);
/// Joins the parts of one collection.
int RunMergeTrials(const cli::MergeOptions& options);
int RunSheet(const cli::DatasetSheetOptions& options);
/// Throws tasks::TaskFileError where the file is bad.
int RunTaskCheck(const cli::TaskCheckOptions& options);
int RunExport(const cli::DatasetExportOptions& options);
int RunFromVideo(const cli::DatasetFromVideoOptions& options);
int RunFromRobomimic(const cli::DatasetFromRobomimicOptions& options);

}  // namespace prospect::tools

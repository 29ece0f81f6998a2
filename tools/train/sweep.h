#pragma once

#include "cli/commands/train.h"

namespace prospect::tools {

// What run options.index of the file options.sweep is trained with. The file is a list of runs,
// each a map of options of train without their dashes:
//
//   - {name: l1, variant: l1}
//   - {name: tuned, finetune: true, without: [views, focus], seed: 2}
//
// They count as if they stood beside what else was typed; the run's folder is --out/NAME (without a
// name its number, from 1). Throws std::invalid_argument with file and run for what cannot be read,
// a number that no run has, and what cannot be typed either or was typed already.
cli::TrainOptions SweptRun(const cli::TrainOptions& options);

}  // namespace prospect::tools

#pragma once

#include <string>

#include "cli/commands/figures.h"
#include "report/page.h"
#include "tools/figures/studio.h"

namespace prospect::figures {

/// The figure of this name (cli::FigureNames()). Throws model::DataError where the data shows
/// nothing of it, model::WeightsError for variants of another task.
report::Page Draw(const std::string& name, const cli::FiguresOptions& options,
                  const Studio& studio);

}  // namespace prospect::figures

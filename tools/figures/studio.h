#pragma once

#include <memory>
#include <string>

#include "cli/commands/figures.h"
#include "tools/figures/held_out.h"
#include "tools/figures/loaded_model.h"
#include "tools/figures/task_table.h"

namespace prospect::figures {

/// What all figures are made from.
struct Studio {
  std::string weights, data;  ///< files
  LoadedModel own;
  std::unique_ptr<HeldOut> held_out;
  TaskTable table;
  int threads = 1;
};

/// Throws model::WeightsError or model::DataError where weights, data and task do not fit.
Studio OpenStudio(const cli::FiguresOptions& options);

/// Weights of another task answer with numbers, too. Throws model::WeightsError, naming `path`.
void RequireTask(const model::Engine& engine, const std::string& path, const std::string& task,
                 const TaskTable& table);

}  // namespace prospect::figures

#include "tools/figures/studio.h"

#include <algorithm>
#include <thread>

#include "cli/installation.h"
#include "cli/options/weights.h"
#include "model/engine.h"
#include "model/jigsaws/gestures.h"
#include "model/weights_error.h"

namespace prospect::figures {
namespace {

void RequireData(const model::Trial& trial, const std::string& path, const std::string& task,
                 const TaskTable& table, const model::EngineInfo& info) {
  if (trial.task != task) {
    throw model::DataError(path + ": holds trials of task '" + trial.task + "', not of '" + task +
                           "'");
  }
  // Videos and the simulated scene share the gestures, and nothing else of a table.
  const bool other = !model::jigsaws::IsGestureTask(task) && trial.task_hash != table.hash;
  if (other || trial.num_actions != table.rules.num_actions) {
    throw model::DataError(path +
                           ": was made with another action table than this task's; collect "
                           "it anew");
  }
  if (trial.width != info.image_width || trial.height != info.image_height) {
    throw model::DataError(path + ": pictures are " + std::to_string(trial.width) + "x" +
                           std::to_string(trial.height) + ", the weights want " +
                           std::to_string(info.image_width) + "x" +
                           std::to_string(info.image_height));
  }
}

}  // namespace

void RequireTask(const model::Engine& engine, const std::string& path, const std::string& task,
                 const TaskTable& table) {
  const model::EngineInfo& info = engine.info();
  if (info.task != task || info.num_actions != table.rules.num_actions) {
    throw model::WeightsError(path + ": was trained for task '" + info.task + "', not for '" +
                              task + "': give weights of that task");
  }
}

Studio OpenStudio(const cli::FiguresOptions& options) {
  Studio studio;
  studio.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 16U));
  studio.table = TableOf(options.task);
  studio.weights = cli::WeightsFile(options.weights, options.task);
  studio.own = LoadWeights(studio.weights, studio.threads);
  RequireTask(*studio.own.engine, studio.weights, options.task, studio.table);
  studio.data = options.data.empty()
                    ? cli::DataFolder("model/held_out") + "/" + options.task + ".h5"
                    : options.data;
  studio.held_out = std::make_unique<HeldOut>(studio.data);
  const model::Trial trial = studio.held_out->Labels(0);
  RequireData(trial, studio.data, options.task, studio.table, studio.own.engine->info());
  return studio;
}

}  // namespace prospect::figures

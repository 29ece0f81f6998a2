#include "tools/common/task_training.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cli/options/task.h"
#include "model/dataset.h"
#include "model/training/derived_config.h"

namespace prospect::tools {
namespace {

bool HasSettings(const tasks::TaskFile& task) { return task.training_line > 0; }

}  // namespace

model::TrainConfig TrainConfigOf(const tasks::TaskFile& task, const std::string& data) {
  model::TrainingSize size{task.spec.image_width, task.spec.image_height,
                           static_cast<int>(task.spec.actions.size()), task.spec.plan_length, 0};
  if (!HasSettings(task)) {
    if (!data.empty()) size.segments = model::Summarize(model::TrialFile(data)).segments;
    return model::DerivedConfig(size);
  }
  model::TrainConfig config;
  config.network.image_width = size.image_width;
  config.network.image_height = size.image_height;
  config.network.num_actions = size.num_actions;
  try {
    nlohmann::json::parse(cli::TrainingSettingsOf(task)).get_to(config);
  } catch (const std::invalid_argument& error) {
    throw tasks::TaskFileError(task.path + ":" + std::to_string(task.training_line) +
                               ": training: " + error.what() +
                               "; 'train --print-config' lists what may be set");
  }
  return config;
}

}  // namespace prospect::tools

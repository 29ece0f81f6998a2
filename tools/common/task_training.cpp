#include "tools/common/task_training.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/hash.h"
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

void RequireSameTable(const tasks::TaskFile& task, const std::string& data) {
  const model::TrialFile file(data);
  if (file.size() == 0) return;
  const model::Trial trial = file.ReadLabels(0);
  const auto differ = [&](const std::string& what) {
    throw model::DataError(data + ": was recorded with another task than " + task.path + ": " +
                           what + "; train with the file it was recorded with, or record anew");
  };
  const auto compare = [&](const std::string& what, const std::string& in_file,
                           const std::string& recorded) {
    if (in_file != recorded)
      differ(what + " is " + in_file + " in the file, " + recorded + " in the data");
  };
  const sim::TaskSpec& spec = task.spec;
  compare("the name", spec.name, trial.task);
  compare("the number of actions", std::to_string(spec.actions.size()),
          std::to_string(trial.num_actions));
  compare("the width of pictures", std::to_string(spec.image_width), std::to_string(trial.width));
  compare("the height of pictures", std::to_string(spec.image_height),
          std::to_string(trial.height));
  if (base::HexText(spec.Hash()) != trial.task_hash)
    differ("names of actions, or what may follow what, are others");
}

}  // namespace prospect::tools

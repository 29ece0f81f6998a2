#include "model/training/config_choices.h"

#include "model/training/recipe.h"
#include "model/training/variants.h"

namespace prospect::model {

TrainConfig ConfigOf(const ConfigChoices& choices) {
  TrainConfig config = choices.task;
  choices.changes.get_to(config);
  if (choices.paper) LeaveOutAll(&config);
  for (const std::string& step : choices.without) LeaveOut(step, &config);
  if (choices.iterations > 0) ScaleIterations(choices.iterations, &config);
  if (!choices.variant.empty()) ApplyVariant(choices.variant, &config);
  if (choices.finetune) config.finetune = true;
  if (!choices.precision.empty()) config.precision = choices.precision;
  if (!choices.labels.empty()) config.labels = choices.labels;
  if (choices.seed >= 0) config.seed = static_cast<std::uint64_t>(choices.seed);
  Validate(config);
  return config;
}

}  // namespace prospect::model

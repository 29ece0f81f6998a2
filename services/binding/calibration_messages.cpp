#include "services/binding/calibration_messages.h"

namespace prospect::services {

void SetSample(const model::CalibrationSample& sample, calibration_t* message) {
  message->refusal_threshold = sample.refusal_threshold;
  message->rule = sample.rule;
  message->parameter_names.clear();
  message->parameter_values.clear();
  for (const auto& [name, value] : sample.parameters) {
    message->parameter_names.push_back(name);
    message->parameter_values.push_back(value);
  }
  message->num_parameters = static_cast<std::int32_t>(message->parameter_names.size());
  message->scores.clear();
  message->classes.clear();
  message->endings.clear();
  for (const model::CalibrationScene& scene : sample.scenes) {
    message->scores.push_back(static_cast<float>(scene.score));
    message->classes.push_back(static_cast<std::uint8_t>(scene.scene_class));
    message->endings.push_back(static_cast<std::uint8_t>(scene.ending));
  }
  message->num_scenes = static_cast<std::int32_t>(message->scores.size());
}

model::CalibrationSample SampleFrom(const calibration_t& message) {
  model::CalibrationSample sample;
  sample.refusal_threshold = message.refusal_threshold;
  sample.rule = message.rule;
  for (std::size_t i = 0; i < message.parameter_names.size(); ++i)
    sample.parameters[message.parameter_names[i]] = message.parameter_values[i];
  for (std::size_t i = 0; i < message.scores.size(); ++i) {
    sample.scenes.push_back({static_cast<double>(message.scores[i]),
                             static_cast<model::SceneClass>(message.classes[i]),
                             static_cast<model::SceneEnding>(message.endings[i])});
  }
  return sample;
}

}  // namespace prospect::services

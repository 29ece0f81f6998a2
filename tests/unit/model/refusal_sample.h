#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "model/refusal/sample.h"

namespace prospect::model {

/// A scene in three words, as in Scene(0.4, 's', 'F'): class s, h or d; ending S, F, T (stopped) or
/// R (refused).
inline CalibrationScene Scene(double score, char scene_class, char ending) {
  const std::string classes = "shd", endings = "SFTR";
  return {score, static_cast<SceneClass>(classes.find(scene_class) + 1),
          static_cast<SceneEnding>(endings.find(ending) + 1)};
}

inline CalibrationSample SampleOf(std::vector<CalibrationScene> scenes) {
  std::stable_sort(scenes.begin(), scenes.end(),
                   [](const auto& a, const auto& b) { return a.score < b.score; });
  CalibrationSample sample;
  sample.scenes = std::move(scenes);
  return sample;
}

}  // namespace prospect::model

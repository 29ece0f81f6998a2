#pragma once

#include "model/refusal/sample.h"

namespace prospect::agent {

// 30 scenes that score 0.2 to 0.229 of which 10 are solved, and 50 that score 0.8 to 0.849, 45.
inline model::CalibrationSample Sample() {
  model::CalibrationSample sample;
  sample.rule = "paper";
  sample.parameters = {{"samples", 30}};
  for (int i = 0; i < 30; ++i)
    sample.scenes.push_back(
        {0.2 + 0.001 * i, model::SceneClass::kSolvable,
         i % 3 == 0 ? model::SceneEnding::kSolved : model::SceneEnding::kFailed});
  for (int i = 0; i < 50; ++i)
    sample.scenes.push_back(
        {0.8 + 0.001 * i, model::SceneClass::kSolvable,
         i % 10 == 5 ? model::SceneEnding::kFailed : model::SceneEnding::kSolved});
  return sample;
}

// The same of scenes with plans of so many actions.
inline model::CalibrationSample Of(int plan_length) {
  model::CalibrationSample sample = Sample();
  sample.parameters["plan_length"] = plan_length;
  return sample;
}

}  // namespace prospect::agent

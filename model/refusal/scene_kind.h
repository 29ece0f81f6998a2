#pragma once

#include <string>

#include "model/refusal/sample.h"

namespace prospect::model {

/// What makes scenes of one task easier or harder than others, whatever is drawn in them. What a
/// calibration shows holds for scenes of its own kind alone. Plain data and pure functions.
struct SceneKind {
  int plan_length = 0;  ///< actions in a complete plan; 0: not known
  int objects = 0;      ///< different things that actions are about; 0: not known
  int tower = 0;        ///< levels of the tower that a plan builds; 0: it builds none
};

/// Why nothing that `sample` says holds for scenes of this kind, in two sentences for a person:
/// what the weights were calibrated on, and by what plans are refused then. Empty where it does
/// hold, and for a sample that is empty or does not say what its scenes were.
std::string NotCovered(const CalibrationSample& sample, const SceneKind& kind);

}  // namespace prospect::model

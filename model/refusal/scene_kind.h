#pragma once

#include <string>
#include <vector>

#include "model/refusal/sample.h"

namespace prospect::model {

/// What makes scenes of one task easier or harder than others, whatever is drawn in them. What a
/// calibration shows holds for scenes of its own kind alone. Plain data and pure functions.
struct SceneKind {
  int plan_length = 0;  ///< actions in a complete plan; 0: not known
  int objects = 0;      ///< different things that actions are about; 0: not known
  int tower = 0;        ///< levels of the tower that a plan builds; 0: it builds none

  bool operator==(const SceneKind&) const = default;
};

/// The kind of the sample's scenes, without the tower: plans and objects say it.
SceneKind KindOf(const CalibrationSample& sample);

/// Of the samples, one for each kind of scenes that the weights were calibrated on, the one for
/// this kind; null where there is none. A sample that does not say what its scenes were holds for
/// all.
const CalibrationSample* CoveringSample(const std::vector<CalibrationSample>& samples,
                                        const SceneKind& kind);

/// Why nothing that `samples` say holds for scenes of this kind, in a sentence for a person: what
/// the weights were calibrated on. Empty where one does hold, and where there are none.
std::string NotCovered(const std::vector<CalibrationSample>& samples, const SceneKind& kind);

}  // namespace prospect::model

#include "model/refusal/scene_kind.h"

#include <algorithm>

namespace prospect::model {
namespace {

// Samples that do not say it were all taken with so many, which is what evaluate has unless told
// otherwise.
constexpr double kObjectsUnlessSaid = 4;

int ParameterOf(const CalibrationSample& sample, const char* name, double otherwise) {
  const auto found = sample.parameters.find(name);
  return static_cast<int>(found == sample.parameters.end() ? otherwise : found->second);
}

bool Fits(const CalibrationSample& sample, const SceneKind& kind) {
  const SceneKind known = KindOf(sample);
  if (known.plan_length == 0) return true;
  const bool longer = kind.plan_length > 0 && kind.plan_length != known.plan_length;
  const bool others = kind.objects > 0 && kind.objects != known.objects;
  return !longer && !others;
}

std::string Plans(const SceneKind& kind, bool with_objects) {
  const std::string plans = "plans of " + std::to_string(kind.plan_length) + " actions";
  return with_objects ? plans + " among " + std::to_string(kind.objects) + " objects" : plans;
}

// Whether any sample is about another number of objects, so that a person is told of them.
bool ObjectsDiffer(const std::vector<CalibrationSample>& samples, const SceneKind& kind) {
  return kind.objects > 0 &&
         std::any_of(samples.begin(), samples.end(), [&](const CalibrationSample& sample) {
           return KindOf(sample).objects != kind.objects;
         });
}

}  // namespace

SceneKind KindOf(const CalibrationSample& sample) {
  return {ParameterOf(sample, "plan_length", 0), ParameterOf(sample, "objects", kObjectsUnlessSaid),
          0};
}

const CalibrationSample* CoveringSample(const std::vector<CalibrationSample>& samples,
                                        const SceneKind& kind) {
  const auto found =
      std::find_if(samples.begin(), samples.end(),
                   [&](const CalibrationSample& sample) { return Fits(sample, kind); });
  return found == samples.end() ? nullptr : &*found;
}

std::string NotCovered(const std::vector<CalibrationSample>& samples, const SceneKind& kind) {
  if (samples.empty() || CoveringSample(samples, kind) != nullptr) return "";
  const bool objects = ObjectsDiffer(samples, kind);
  std::string known;
  for (const CalibrationSample& sample : samples)
    known += (known.empty() ? "" : " and on ") + Plans(KindOf(sample), objects);
  std::string asked = Plans(kind, false);
  if (objects) asked += " among " + std::to_string(kind.objects);
  if (kind.tower > 0) asked = "towers of " + std::to_string(kind.tower) + " (" + asked + ")";
  return "These weights were calibrated on " + known + ", not on " + asked +
         ", and may not have been trained for them: how often they succeed here is not known.";
}

}  // namespace prospect::model

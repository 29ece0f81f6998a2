#include "model/refusal/scene_kind.h"

namespace prospect::model {
namespace {

// Samples that do not say it were all taken with so many, which is what evaluate has unless told
// otherwise.
constexpr double kObjectsUnlessSaid = 4;

int ParameterOf(const CalibrationSample& sample, const char* name, double otherwise) {
  const auto found = sample.parameters.find(name);
  return static_cast<int>(found == sample.parameters.end() ? otherwise : found->second);
}

std::string Plans(int plan_length) {
  return "plans of " + std::to_string(plan_length) + " actions";
}

}  // namespace

std::string NotCovered(const CalibrationSample& sample, const SceneKind& kind) {
  const int plan_length = ParameterOf(sample, "plan_length", 0);
  if (sample.empty() || plan_length == 0) return "";
  const int objects = ParameterOf(sample, "objects", kObjectsUnlessSaid);
  const bool longer = kind.plan_length > 0 && kind.plan_length != plan_length;
  const bool others = kind.objects > 0 && kind.objects != objects;
  if (!longer && !others) return "";
  std::string known = Plans(plan_length), asked = Plans(kind.plan_length);
  if (others) known += " among " + std::to_string(objects) + " objects";
  if (others) asked += " among " + std::to_string(kind.objects);
  if (longer && kind.tower > 0)
    asked = "towers of " + std::to_string(kind.tower) + " (" + asked + ")";
  return "These weights were calibrated on " + known + ", not on " + asked +
         ", and may not have been trained for them: how often they succeed here is not known.";
}

}  // namespace prospect::model

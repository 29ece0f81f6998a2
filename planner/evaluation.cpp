#include "planner/evaluation.h"

#include <cmath>

namespace prospect::planner {
namespace {

constexpr float kSteps = 65535.0f;

// False for NaN too.
bool InUnit(float x) { return x >= 0.0f && x <= 1.0f; }

bool AllInUnit(const std::vector<float>& numbers) {
  for (const float x : numbers) {
    if (!InUnit(x)) return false;
  }
  return true;
}

}  // namespace

std::uint16_t Quantize(float x) {
  if (!(x > 0.0f)) return 0;
  if (x >= 1.0f) return 65535;
  return static_cast<std::uint16_t>(std::lround(static_cast<double>(x) * kSteps));
}

float Dequantize(std::uint16_t n) { return static_cast<float>(n) / kSteps; }

std::vector<std::uint16_t> Quantize(const std::vector<float>& x) {
  std::vector<std::uint16_t> result;
  result.reserve(x.size());
  for (const float one : x) result.push_back(Quantize(one));
  return result;
}

std::vector<float> Dequantize(const std::vector<std::uint16_t>& n) {
  std::vector<float> result;
  result.reserve(n.size());
  for (const std::uint16_t one : n) result.push_back(Dequantize(one));
  return result;
}

Evaluation AsOnTheWire(const Evaluation& evaluation) {
  Evaluation result = evaluation;
  result.q = Dequantize(Quantize(evaluation.q));
  result.p = Dequantize(Quantize(evaluation.p));
  return result;
}

const char* Defect(const Evaluation& evaluation, int num_actions) {
  const auto wanted = static_cast<std::size_t>(num_actions);
  if (evaluation.q.size() != wanted) return "q does not have one number for each action";
  if (evaluation.p.size() != wanted) return "p does not have one number for each action";
  if (!InUnit(evaluation.value)) return "V is not in [0, 1]";
  if (!InUnit(evaluation.done)) return "f is not in [0, 1]";
  if (!AllInUnit(evaluation.q)) return "a Q is not in [0, 1]";
  if (!AllInUnit(evaluation.p)) return "a p is not in [0, 1]";
  return "";
}

}  // namespace prospect::planner

// What the networks say about one node: V(h), f(h0, h, a), and for each next action Q and p (paper,
// section III, "Value functions" and "Structure prior"). Plain data without a torch type; safe from
// any thread.
#pragma once

#include <cstdint>
#include <vector>

namespace prospect::planner {

struct Evaluation {
  float value = 0;  // V(h): probability of success from here on, [0, 1]
  float done = 1;   // f(h0, h, a): the action that led here finished, [0, 1]; unused at the root
  std::vector<float> q;  // Q(h0, h, a, a') for each action a', [0, 1]; size num_actions
  std::vector<float> p;  // p(a' | h0, h, a) for each action a', [0, 1]; size num_actions
};

// Q and p travel as 16-bit fractions of 65535 (rounded to nearest; numbers outside [0, 1] are
// clamped, NaN gives 0). Dequantize(Quantize(x)) differs from x by at most 1/131070, and
// Quantize(Dequantize(n)) == n for every n.
std::uint16_t Quantize(float x);
float Dequantize(std::uint16_t n);
std::vector<std::uint16_t> Quantize(const std::vector<float>& x);
std::vector<float> Dequantize(const std::vector<std::uint16_t>& n);

// The evaluation as every receiver sees it: Q and p through the wire's rounding, V and f as they
// are (they travel as 32-bit floats). Idempotent. Search and the drivers always use this form, so
// that a local model and one over the bus give the same tree.
Evaluation AsOnTheWire(const Evaluation& evaluation);

// Empty when sound; otherwise what is wrong: sizes that are not num_actions, numbers that are not
// in [0, 1].
const char* Defect(const Evaluation& evaluation, int num_actions);

}  // namespace prospect::planner

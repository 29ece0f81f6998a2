#pragma once

#include <string>
#include <vector>

#include "sim/mesh.h"

namespace prospect::sim {

// What makes a task's pictures unlike those that its networks were trained on: for measuring what
// a model does with what it has never seen. A shift changes pictures alone. Scenes, physics,
// execution noise and verdicts stay what they are without it, bit for bit, and so do the world's
// version and what an oracle says.
struct Shift {
  // Scale of all light, beside the trial's own, which is 0.9 to 1.1. Not negative.
  double light = 1;
  // Degrees that the observed camera is turned about the point that it looks at. Stacking: about
  // the upright through it. Navigation, whose camera looks straight down: about the picture's
  // vertical axis, so that it sees the site aslant.
  double camera = 0;
  // Degrees that the blocks' (navigation: the objects') hues are turned. Greys stay grey.
  double hue = 0;
};

// `color` with its hue turned by `degrees`: red becomes yellow by 60, green by 120. Brightest and
// darkest channel keep their values. By 0 degrees it is the same bits.
Color TurnedHue(const Color& color, double degrees);

// The factors that a SetShift takes (sim/task_factory.h): "light", "camera", "colour", "noise".
const std::vector<std::string>& ShiftFactors();

// Strengths are 1 to this; 0 is no shift.
inline constexpr int kShiftStrengths = 5;

// What `strength` (1 to kShiftStrengths) of a factor stands for: Shift::light, Shift::camera
// (degrees), Shift::hue (degrees), or the standard deviation of the sensor noise as a share of full
// range, which is 0.01 without a shift. Throws std::invalid_argument that names what there is.
double ShiftAmount(const std::string& factor, int strength);

// The same for people: "light x 0.6", "camera turned by 4 degrees".
std::string ShiftText(const std::string& factor, int strength);

}  // namespace prospect::sim

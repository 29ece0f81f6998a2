#pragma once

#include "base/random.h"
#include "sim/footprint.h"
#include "sim/husky.h"
#include "sim/navigation/parameters.h"

namespace prospect::sim {

// What a leg's execution makes of the command: drawn once a leg.
struct LegNoise {
  double heading = 0;  // rad added to the heading that is held
  double speed = 1;    // factor on the speed
};

LegNoise DrawLegNoise(const NavigationParameters& parameters, base::Random random);

// Drives towards a point: turns in place until it faces it, then drives straight with small
// corrections and slows down before it arrives. It plans no path and looks at no obstacle, so it
// runs into whatever stands in the way.
class GotoController {
 public:
  GotoController() = default;

  // Begins a leg towards (x, y) in the site's frame.
  void Begin(double x, double y, const LegNoise& noise);

  // The command for the next step of `dt` seconds. `gap`: distance from the hull to the target's
  // face (m).
  Twist2 Update(const NavigationParameters& parameters, const Pose2& pose, double gap, double dt);

  // Whether the turn in place is over.
  bool driving() const { return driving_; }

 private:
  double x_ = 0;
  double y_ = 0;
  LegNoise noise_;
  Twist2 command_;  // the last one, for the ramps
  bool driving_ = false;
};

}  // namespace prospect::sim

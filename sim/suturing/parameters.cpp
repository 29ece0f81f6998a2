#include "sim/suturing/parameters.h"

#include <cstdio>
#include <sstream>

#include "base/hash.h"

namespace prospect::sim {
namespace {

// Raised by hand when code changes what a seed gives without changing a constant.
constexpr int kRevision = 1;

}  // namespace

const SuturingParameters& TheSuturingParameters() {
  static const SuturingParameters parameters;
  return parameters;
}

std::string SuturingWorldVersion() {
  const SuturingParameters& p = TheSuturingParameters();
  std::ostringstream text;
  text.precision(9);
  text << kRevision << ' ' << p.throws;
  for (double value : {p.throw_gap,     p.first_throw,   p.half_bite,
                       p.half_width,    p.half_length,   p.half_table,
                       p.pad_height,    p.needle_radius, p.wire_radius,
                       p.needle_mass,   p.right_grip,    p.left_grip,
                       p.plane_tilt,    p.emerge,        p.friction,
                       p.hand_mass,     p.hand_inertia,  p.hand_force,
                       p.hand_torque,   p.hand_speed,    p.hand_turn_speed,
                       p.servo_gain,    p.jaw_speed,     p.jaw_open,
                       p.jaw_closed,    p.reach,         p.wrist,
                       p.trocar_x,      p.trocar_y,      p.trocar_z,
                       p.wander,        p.end_noise,     p.turn_noise,
                       p.bite_noise,    p.grip_noise,    p.time_noise,
                       p.tremor,        p.tolerance,     p.turn_tolerance,
                       p.slip,          p.bad_bite,      p.bad_bite_size,
                       p.bad_grip,      p.bad_grip_size, p.dot_tolerance,
                       p.gesture_limit, p.trial_limit,   p.light_range,
                       p.step}) {
    text << ' ' << value;
  }
  return "suturing-" + base::HexText(base::HashText(text.str()));
}

}  // namespace prospect::sim

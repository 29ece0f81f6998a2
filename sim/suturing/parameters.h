#pragma once

#include <string>

namespace prospect::sim {

// The suturing world's constants: metres, seconds, radians, kilograms. Any change gives the world
// another version. The frame: the middle of the pad's top is the origin, x to the picture's right
// (the side on which the needle enters), y along the cut away from the surgeon, z up.
struct SuturingParameters {
  // the pad and what is marked on it
  int throws = 4;              // stitches of a whole trial
  double throw_gap = 10e-3;    // between stitches along the cut
  double first_throw = 15e-3;  // y of the first one; the others follow towards the surgeon
  double half_bite = 6e-3;     // from the cut to each dot
  double half_width = 34e-3;   // of the pad, along x
  double half_length = 27e-3;  // of the pad, along y
  double half_table = 0.25;    // of what lies under the pad
  double pad_height = 6e-3;

  // the needle: half a circle
  double needle_radius = 9e-3;
  double wire_radius = 0.55e-3;
  double needle_mass = 0.6e-3;
  double right_grip = 2.62;  // angle from the tip at which the right hand holds it
  double left_grip = 0.21;   // and the left hand
  double plane_tilt = 0.35;  // of the driven needle's plane from upright, top away from the surgeon
  double emerge = 0.96;      // how far the tip comes out of the tissue before it is taken over
  double friction = 0.6;

  // the instruments
  double hand_mass = 0.05;
  double hand_inertia = 2e-6;     // kg m^2
  double hand_force = 6.0;        // N, limit of what moves a hand
  double hand_torque = 0.06;      // N m
  double hand_speed = 0.35;       // m/s, limit
  double hand_turn_speed = 14.0;  // rad/s, limit
  double servo_gain = 0.4;        // share of the error that a step makes up for
  double jaw_speed = 2.5;         // rad/s
  double jaw_open = 0.75;         // angle between the jaws
  double jaw_closed = 0.09;       // about a needle
  double reach = 1.6e-3;          // within which closing jaws catch needle or thread
  double wrist = 12e-3;           // from between the jaws' tips back to the wrist
  double trocar_x = 78e-3;        // where a shaft enters the body: mirrored for the left one
  double trocar_y = -100e-3;
  double trocar_z = 86e-3;

  // how the surgeon moves
  double wander = 4e-3;         // deviation of a free path's via points
  double end_noise = 0.5e-3;    // of where a hand ends
  double turn_noise = 0.03;     // of how it ends
  double bite_noise = 0.3e-3;   // of the needle's tip from its dot
  double grip_noise = 0.25e-3;  // of where the needle is gripped
  double time_noise = 0.12;     // share, of a phase's duration
  double tremor = 0.08e-3;      // amplitude
  double tolerance = 0.35e-3;   // within which a hand has arrived
  double turn_tolerance = 0.05;
  double slip = 0.004;      // chance that a hand loses the needle while it carries it
  double bad_bite = 0.008;  // chance that the needle is set far from its dot
  double bad_bite_size = 4e-3;
  double bad_grip = 0.002;  // chance that a hand reaches beside the needle
  double bad_grip_size = 3e-3;

  // verdict
  double dot_tolerance = 2.5e-3;  // of the tip from its dot
  double gesture_limit = 30;
  double trial_limit = 400;

  // light
  double light_range = 0.10;  // share of the light's scale either way

  // physics
  double step = 1.0 / 600;
};

const SuturingParameters& TheSuturingParameters();

// Names the world: "suturing-" and a hash of the constants above.
std::string SuturingWorldVersion();

}  // namespace prospect::sim

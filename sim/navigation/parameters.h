#pragma once

#include <string>

namespace prospect::sim {

// The navigation world's constants: chosen by measurement with prospect oracle so that random
// orders fail 50 to 70 % of the time while most sites can be solved. Any change gives the world
// another version.
struct NavigationParameters {
  // site
  double half_view = 3.84;      // m from the centre to the picture's edge; also the site's border
  double camera_height = 12.0;  // m
  double object_range =
      3.05;  // objects stand within this square (m from the centre, whole footprint)
  double start_range = 2.6;  // the robot's centre starts within this square
  double object_gap = 0.75;  // least distance between the faces of two objects (m)
  double start_gap = 0.05;   // least distance from the robot's hull to an object at the start (m)

  // one leg
  double reach = 0.5;              // m from the hull to the object's face that counts as there
  double time_limit = 10.0;        // s
  double speed = 0.45;             // m/s
  double turn_rate = 0.9;          // rad/s
  double acceleration = 1.2;       // m/s^2, also when braking before the object
  double turn_acceleration = 3.0;  // rad/s^2
  double aim_tolerance = 0.05;     // rad; then the robot stops turning in place and drives
  double settle_time = 0.6;        // s it may take to come to rest at the object

  // execution noise, drawn once a leg
  double heading_noise = 0.015;  // rad, deviation of the heading that is held
  double speed_noise = 0.02;     // share, deviation of the speed

  // light
  double light_range = 0.10;  // share of the light's scale either way

  // physics
  double step = 0.01;  // s
  double tick = 0.1;   // s, the camera's period
};

const NavigationParameters& TheNavigationParameters();

// Names the world: "navigation-" and a hash of the constants above and of the objects' shapes.
std::string NavigationWorldVersion();

}  // namespace prospect::sim

#pragma once

#include <cstdint>
#include <vector>

#include "sim/footprint.h"
#include "sim/navigation/parameters.h"

namespace prospect::sim {

struct PlacedObject {
  int kind = 0;  // index into ObjectCatalogue(), and the action that investigates it
  Pose2 pose;
};

// One construction site: what stands where, where the robot starts, and how bright it is.
struct NavigationScene {
  std::vector<PlacedObject> objects;  // ascending by kind; each kind at most once
  Pose2 start;
  double light = 1.0;
};

bool operator==(const NavigationScene& a, const NavigationScene& b);

// Draws the site of `seed` with `objects` objects (4 to 7): the paper's four and random others, at
// random poses at least object_gap apart, the robot start_gap from all of them. Always terminates:
// a site that cannot be filled is drawn anew.
NavigationScene DrawScene(std::uint64_t seed, int objects, const NavigationParameters& parameters);

// Distance from the face of `object` to the robot's hull at `pose` (m); 0 when they touch.
double DistanceToHull(const PlacedObject& object, const Pose2& pose);

}  // namespace prospect::sim

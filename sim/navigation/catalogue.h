#pragma once

#include <string>
#include <vector>

#include "sim/footprint.h"
#include "sim/mesh.h"

namespace prospect::sim {

// A kind of thing that stands on the construction site. All are fixed to the ground.
struct ObjectKind {
  std::string name;
  Footprint footprint;  // what the robot can run into, over the whole height
  double height = 0;    // m
  VisualBody visual;    // in its own frame: z = 0 is the ground
};

// The seven kinds in the frozen order of the action table: the paper's four, then three more. Each
// differs from all others in colour and shape as seen from above.
const std::vector<ObjectKind>& ObjectCatalogue();

// The site's ground: pale earth in faint tiles, with a marked border at `half_size` m from the
// centre. It is the same under the eight turns and mirrorings of a square.
Color GroundColorAt(double x, double y, double half_size);

}  // namespace prospect::sim

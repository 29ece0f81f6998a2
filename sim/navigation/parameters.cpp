#include "sim/navigation/parameters.h"

#include <cstdio>
#include <sstream>

#include "base/hash.h"
#include "sim/navigation/catalogue.h"

namespace prospect::sim {
namespace {

// Raised by hand when code changes what a seed gives without changing a constant.
constexpr int kRevision = 1;

}  // namespace

const NavigationParameters& TheNavigationParameters() {
  static const NavigationParameters parameters;
  return parameters;
}

std::string NavigationWorldVersion() {
  const NavigationParameters& p = TheNavigationParameters();
  std::ostringstream text;
  text.precision(9);
  text << kRevision;
  for (double value : {p.half_view, p.camera_height, p.object_range, p.start_range, p.object_gap,
                       p.start_gap, p.reach, p.time_limit, p.speed, p.turn_rate, p.acceleration,
                       p.turn_acceleration, p.aim_tolerance, p.settle_time, p.heading_noise,
                       p.speed_noise, p.light_range, p.step, p.tick}) {
    text << ' ' << value;
  }
  for (const ObjectKind& kind : ObjectCatalogue()) {
    const Footprint& f = kind.footprint;
    text << '\n'
         << kind.name << ' ' << f.half_x << ' ' << f.half_y << ' ' << f.radius << ' '
         << kind.height;
  }
  return "navigation-" + base::HexText(base::HashText(text.str()));
}

}  // namespace prospect::sim

#include "sim/navigation/catalogue.h"

#include <algorithm>
#include <cmath>

namespace prospect::sim {
namespace {

// A steel drum: blue, with a pale lid.
ObjectKind Barrel() {
  const Color blue(0.10f, 0.25f, 0.80f), pale(0.55f, 0.75f, 0.98f);
  ObjectKind kind{"barrel", Footprint::Disc(0.32), 0.9, {}};
  kind.visual.push_back(Cylinder({0, 0, 0.45f}, 0.32f, 0.9f, blue));
  kind.visual.push_back(Cylinder({0, 0, 0.91f}, 0.16f, 0.04f, pale));
  return kind;
}

// A long road barrier in red and white stripes.
ObjectKind Barricade() {
  const Color red(0.85f, 0.10f, 0.10f), white(0.97f, 0.97f, 0.95f);
  ObjectKind kind{"barricade", Footprint::Rectangle(1.75, 0.34), 0.8, {}};
  for (int i = 0; i < 5; ++i) {
    const float x = 0.35f * static_cast<float>(i - 2);
    kind.visual.push_back(Box({x, 0, 0.4f}, {0.35f, 0.34f, 0.8f}, i % 2 == 0 ? red : white));
  }
  return kind;
}

// A traffic cone on a bright foot. Slanting faces look dark from above, so flat rings carry its
// colours.
ObjectKind Pylon() {
  const Color orange(1.0f, 0.45f, 0.0f), white(1.0f, 1.0f, 0.98f);
  ObjectKind kind{"pylon", Footprint::Rectangle(0.56, 0.56), 0.75, {}};
  kind.visual.push_back(Box({0, 0, 0.03f}, {0.56f, 0.56f, 0.06f}, orange));
  kind.visual.push_back(Cylinder({0, 0, 0.16f}, 0.21f, 0.2f, white));
  kind.visual.push_back(Cylinder({0, 0, 0.36f}, 0.13f, 0.2f, orange));
  kind.visual.push_back(Frustum({0, 0, 0.46f}, 0.13f, 0.05f, 0.29f, orange));
  return kind;
}

// A cast concrete block with a lifting recess.
ObjectKind Block() {
  const Color grey(0.80f, 0.82f, 0.84f), dark(0.45f, 0.46f, 0.48f);
  ObjectKind kind{"block", Footprint::Rectangle(0.84, 0.84), 0.6, {}};
  kind.visual.push_back(Box({0, 0, 0.3f}, {0.84f, 0.84f, 0.6f}, grey));
  kind.visual.push_back(Box({0, 0, 0.6f}, {0.34f, 0.12f, 0.02f}, dark));
  kind.visual.push_back(Box({0, 0, 0.6f}, {0.12f, 0.34f, 0.02f}, dark));
  return kind;
}

// A cable spool lying on its side: a wooden disc with a dark hub.
ObjectKind Spool() {
  const Color wood(0.50f, 0.28f, 0.12f), rim(0.68f, 0.42f, 0.20f), hub(0.08f, 0.06f, 0.05f);
  ObjectKind kind{"spool", Footprint::Disc(0.46), 0.5, {}};
  kind.visual.push_back(Cylinder({0, 0, 0.25f}, 0.46f, 0.5f, wood));
  kind.visual.push_back(Cylinder({0, 0, 0.51f}, 0.33f, 0.02f, rim));
  kind.visual.push_back(Cylinder({0, 0, 0.53f}, 0.15f, 0.02f, hub));
  return kind;
}

// A green generator with a dark grille at one end.
ObjectKind Generator() {
  const Color green(0.10f, 0.55f, 0.20f), dark(0.05f, 0.22f, 0.09f);
  ObjectKind kind{"generator", Footprint::Rectangle(1.10, 0.60), 0.7, {}};
  kind.visual.push_back(Box({0, 0, 0.35f}, {1.10f, 0.60f, 0.7f}, green));
  kind.visual.push_back(Box({0.30f, 0, 0.71f}, {0.30f, 0.46f, 0.02f}, dark));
  return kind;
}

// A site cabin: a turquoise roof crossed by a pale stripe.
ObjectKind Cabin() {
  const Color turquoise(0.05f, 0.68f, 0.72f), pale(0.88f, 0.98f, 0.98f);
  ObjectKind kind{"cabin", Footprint::Rectangle(0.95, 0.95), 1.4, {}};
  kind.visual.push_back(Box({0, 0, 0.7f}, {0.95f, 0.95f, 1.4f}, turquoise));
  kind.visual.push_back(Box({0, 0, 1.41f}, {0.95f, 0.22f, 0.02f}, pale));
  return kind;
}

}  // namespace

const std::vector<ObjectKind>& ObjectCatalogue() {
  static const std::vector<ObjectKind> catalogue = {Barrel(), Barricade(), Pylon(), Block(),
                                                    Spool(),  Generator(), Cabin()};
  return catalogue;
}

Color GroundColorAt(double x, double y, double half_size) {
  const double edge = std::max(std::abs(x), std::abs(y));
  if (edge > half_size - 0.10) return Color(0.30f, 0.30f, 0.33f);
  constexpr double kTile =
      1.28;  // one tile is centred on the site: mirrored tiles have equal shades
  const int column = static_cast<int>(std::floor(x / kTile + 0.5));
  const int row = static_cast<int>(std::floor(y / kTile + 0.5));
  const float shade = (column + row) % 2 == 0 ? 1.0f : 0.96f;
  return Color(0.62f, 0.55f, 0.44f) * shade;
}

}  // namespace prospect::sim

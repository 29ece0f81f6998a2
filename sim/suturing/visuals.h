#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/mesh.h"
#include "sim/suturing/scene.h"

namespace prospect::sim {

// What the endoscope sees: shapes of instruments and needle, and the pad's top as a picture.

// One jaw, in a frame at the wrist's pin with z towards its tip and x outwards.
VisualBody JawVisual(const SuturingParameters& p);
// The wrist about the pin, z towards the jaws.
VisualBody WristVisual(const SuturingParameters& p);
// The shaft from the wrist (origin) along z.
VisualBody ShaftVisual(const SuturingParameters& p);
// The wire, in the needle's frame.
VisualBody NeedleVisual(const SuturingParameters& p);
// Table and pad; the pad's top is z = 0.
VisualBody StillVisual(const SuturingParameters& p, const SuturingLook& look);

// The colours of the pad's top: mottled, a cut along y, and a dot at each entry and exit point.
class PadTexture {
 public:
  PadTexture(const SuturingParameters& p, const SuturingLook& look);

  // At a point of the pad (m); outside it, that of its edge.
  Color At(float x, float y) const;

 private:
  Color& Texel(int column, int row) {
    return texels_[static_cast<std::size_t>(row) * columns_ + column];
  }
  const Color& Texel(int column, int row) const {
    return texels_[static_cast<std::size_t>(row) * columns_ + column];
  }
  void Mottle(const SuturingLook& look);
  void Mark(const SuturingParameters& p, const SuturingLook& look);

  float half_width_, half_length_;
  int columns_, rows_;
  std::vector<Color> texels_;
};

}  // namespace prospect::sim

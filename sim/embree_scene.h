#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "sim/mesh.h"

namespace prospect::sim {

// The process's one Embree device: one thread, SSE 4.2. Throws std::runtime_error if there is none.
RTCDevice SharedEmbreeDevice();

// One rigid body's triangles as a committed Embree scene: geometry i is part i.
class EmbreeBody {
 public:
  explicit EmbreeBody(const VisualBody& body);
  ~EmbreeBody();
  EmbreeBody(const EmbreeBody&) = delete;
  EmbreeBody& operator=(const EmbreeBody&) = delete;

  RTCScene scene() const { return scene_; }
  const Color& color(unsigned part) const { return colors_[part]; }

 private:
  void Add(const VisualPart& part);

  RTCScene scene_;
  std::vector<Color> colors_;
};

}  // namespace prospect::sim

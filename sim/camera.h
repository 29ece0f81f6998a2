#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <vector>

#include "sim/image.h"
#include "sim/mesh.h"

namespace prospect::sim {

// Where the camera hangs: above the origin of the ground z = 0, looking straight down; +x is right
// and +y is up in the picture.
struct AerialView {
  double height = 12.0;       // m above the ground
  double half_extent = 3.84;  // m of ground from the centre to the edge of a square picture
  double tilt = 0;  // rad that it is turned about the ground's y axis, still looking at the origin;
                    // below pi / 4 either way
};

// An aerial camera that casts rays with Embree: nine a pixel, Lambert shading under a light from
// straight above, no GL and no window. What stands still is rendered once; a picture then only
// re-traces the pixels that a moving body may cover, in that body's own frame, so nothing is
// rebuilt between pictures.
//
// Embree is held to one thread and to SSE 4.2, so that pictures are the same bits on every x86-64
// processor. Threads: one thread at a time per object. Make cameras after a fork, not before.
class AerialCamera {
 public:
  using GroundColor = std::function<Color(double x, double y)>;

  // `moving` bodies keep their order; poses given later follow it.
  AerialCamera(const AerialView& view, GroundColor ground, const VisualBody& still,
               const std::vector<VisualBody>& moving);
  ~AerialCamera();
  AerialCamera(const AerialCamera&) = delete;
  AerialCamera& operator=(const AerialCamera&) = delete;

  // The picture with the moving bodies at `poses` (body to site), every colour times `light`. width
  // and height 1..2048, else std::invalid_argument; a wider picture sees more ground sideways.
  Image Render(const std::vector<Eigen::Isometry3d>& poses, double light, int width, int height);

  // How many pixels of a width x height picture have a moving body at their centre.
  int CountMovingPixels(const std::vector<Eigen::Isometry3d>& poses, int width, int height);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace prospect::sim

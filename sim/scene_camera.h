#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "sim/image.h"
#include "sim/mesh.h"
#include "sim/tabletop/scene_description.h"

namespace prospect::sim {

// What a SceneCamera shows: one thing that stands still and others that move as rigid pieces.
struct SceneVisuals {
  VisualBody still;
  std::vector<VisualBody> moving;  // poses given later follow this order
  LightDescription light;
};

// The table and the arm's foot stand still; moving are the six links (the palm with the last), the
// two fingers, the blocks, the obstacle.
SceneVisuals TabletopVisuals(const TabletopDescription& scene);

// What a pixel's centre shows, row by row from the top.
struct DepthImage {
  static constexpr int kSky = -2;
  static constexpr int kStill = -1;
  int width = 0;
  int height = 0;
  std::vector<float> depth;  // m along the view's axis; infinite for the sky
  std::vector<int> body;     // index of the moving body, or kStill, or kSky
};

// Where `point` (world) is in a square picture from `view`: x from the left edge (0) to the right
// (1), y from the upper edge down. Both NaN behind the camera.
Eigen::Vector2d SeenAt(const CameraDescription& view, const Eigen::Vector3d& point);

// A pinhole camera that casts rays with Embree: four samples a pixel, Lambert shading under one
// lamp with hard shadows and an even light from all sides; no GL, no window.
//
// Embree is held to one thread and to SSE 4.2, so that pictures are the same bits on every x86-64
// processor. What nothing touched since a small picture of the same view and light is not traced
// again (sim/traced_picture.h). Threads: one at a time per object. Make cameras after a fork, not
// before.
class SceneCamera {
 public:
  explicit SceneCamera(const SceneVisuals& visuals);
  ~SceneCamera();
  SceneCamera(const SceneCamera&) = delete;
  SceneCamera& operator=(const SceneCamera&) = delete;

  // The picture from `view` with the moving bodies at `poses`, every colour times `light`. width
  // and height 1 to 4096, else std::invalid_argument, also for another number of poses.
  Image Render(const CameraDescription& view, const std::vector<Eigen::Isometry3d>& poses,
               double light, int width, int height);

  DepthImage RenderDepth(const CameraDescription& view, const std::vector<Eigen::Isometry3d>& poses,
                         int width, int height);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace prospect::sim

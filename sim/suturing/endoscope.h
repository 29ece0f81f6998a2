#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "sim/image.h"
#include "sim/suturing/scene.h"
#include "sim/suturing/thread.h"

namespace prospect::sim {

// What an endoscope sees of a suturing scene: a pinhole camera that casts rays with Embree, its
// lamp beside the lens, so that light falls off with distance, metal and wet tissue shine, and
// shadows stay narrow; the picture darkens towards its corners. Rays as in sim/scene_camera.h: one
// thread, SSE 4.2, the same bits on every x86-64 processor, and nothing traced again in vain.
//
// Threads: one at a time per object. Make it after a fork, not before.
class Endoscope {
 public:
  // Things that move, in the order in which Render wants their poses: of the right instrument the
  // two jaws, the wrist and the shaft, then those of the left one, then the needle.
  static constexpr int kMoving = 9;

  Endoscope(const SuturingParameters& parameters, const SuturingLook& look);
  ~Endoscope();
  Endoscope(const Endoscope&) = delete;
  Endoscope& operator=(const Endoscope&) = delete;

  // width and height 1 to 4096, else std::invalid_argument, also for another number of poses.
  // `sideways` shifts the lens to the right (m), for the other eye of a stereo pair.
  Image Render(const std::vector<Eigen::Isometry3d>& poses, const std::vector<Strand>& thread,
               double light, double sideways, int width, int height);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Where `point` is in a picture of that size: x from the left edge (0) to the right (1), y from the
// upper edge down. NaN behind the lens.
Eigen::Vector2d SeenAt(const SuturingLook& look, const Eigen::Vector3d& point, int width,
                       int height);

// Poses for Render of an instrument whose hand is at `hand` with its jaws open by `opening` (rad):
// appended to *poses. The shaft runs from the wrist to where the instrument enters the body.
void AppendInstrument(const SuturingParameters& p, int hand, const Eigen::Isometry3d& pose,
                      double opening, std::vector<Eigen::Isometry3d>* poses);

}  // namespace prospect::sim

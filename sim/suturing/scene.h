#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "sim/mesh.h"
#include "sim/suturing/parameters.h"
#include "sim/suturing/phases.h"

namespace prospect::sim {

// What a trial looks like, apart from what moves.
struct SuturingLook {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();     // of the endoscope
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  // at which it looks
  double fov = 0.6;                                  // vertical (rad)
  Color pad = Color::Zero();
  Color cut = Color::Zero();
  Color dot = Color::Zero();
  Color table = Color::Zero();
  Color thread = Color::Zero();
  std::uint64_t texture = 0;  // seed of the pad's mottling
};

// One trial's beginning.
struct SuturingScene {
  std::uint64_t seed = 0;
  std::array<Eigen::Isometry3d, 2> hands;
  Eigen::Isometry3d needle = Eigen::Isometry3d::Identity();
  Eigen::Vector3d thread_end = Eigen::Vector3d::Zero();
  double thread_length = 0;
  double thread_side = 1;
  SurgeonStyle style;
  SuturingLook look;
  double light = 1;
};

// Surgeons whose ways differ; the numbers of JIGSAWS' eight, B to I.
inline constexpr int kSurgeons = 8;

// How surgeon `i` works: two are quick and sure, two less so, four are novices, as among those of
// JIGSAWS.
SurgeonStyle StyleOf(int surgeon);

// Draws the scene of `seed`; the surgeon, too, if `surgeon` is -1.
SuturingScene DrawSuturingScene(std::uint64_t seed, int surgeon, const SuturingParameters& p);

}  // namespace prospect::sim

#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/suturing/parameters.h"

namespace prospect::sim {

// The suture's thread, as it is drawn. It is no physical body: it follows the needle's tail, hangs
// and lies in curves whose length is kept while nobody pulls, and runs straight where a gesture
// pulls it. Its total length is not conserved: more comes out of the tissue than went in.
struct SuturingThread {
  static constexpr int kMost = 8;  // stitches

  struct Stitch {
    Eigen::Vector3d entry = Eigen::Vector3d::Zero();
    Eigen::Vector3d exit = Eigen::Vector3d::Zero();
  };
  std::array<Stitch, kMost> stitches;
  int passed = 0;  // stitches through which the thread runs

  Eigen::Vector3d end = Eigen::Vector3d::Zero();  // where it begins, on the pad
  double length = 0;      // m, of the part between the last stitch (or `end`) and the needle
  double feed = 0;        // m, of the part before the last stitch, beyond the straight line
  bool in_right = false;  // the right hand holds it between the last stitch and the needle
  double side = 1;        // -1 or 1: to which side slack falls
  bool entered =
      false;  // the needle is in the tissue of the next stitch, both its points are known

  // Where the part that leads to the needle leaves the tissue, or `end`.
  Eigen::Vector3d Anchor() const;

  // Makes `length` reach from the anchor (by way of `right`, if the right hand holds it) to `tail`.
  void Reach(const Eigen::Vector3d& tail, const Eigen::Vector3d& right, bool taut);

  // The middle of the part that leads to the needle's tail.
  Eigen::Vector3d Middle(const Eigen::Vector3d& tail) const;
};

// A visible piece of the thread, as a chain of points.
using Strand = std::vector<Eigen::Vector3d>;

// What is visible with the needle's tail at `tail` and the right hand's jaws at `right`.
std::vector<Strand> ThreadStrands(const SuturingThread& thread, const Eigen::Vector3d& tail,
                                  const Eigen::Vector3d& right);

}  // namespace prospect::sim

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "sim/mesh.h"
#include "sim/view_cells.h"

namespace prospect::sim {

// How a ray of a picture went: what tells whether the next picture needs it anew.
struct Trail {
  static constexpr int kNothing = -1;
  int piece = kNothing;               // that it met
  int lamp_cell = ViewCells::kNever;  // of the lamp's view where its shadow was asked for
  bool lit = false;                   // no shadow was there
};

// What differs between one picture and the next one of the same view, in the same light: which
// pieces moved, where they may be seen, where their shadows may fall or fell. It may say too much,
// never too little, so a ray that it does not touch meets what it met before.
//
// Threads: one at a time per object.
class PictureChanges {
 public:
  // A box that holds a part of a piece, and where it is.
  struct Placed {
    Eigen::AlignedBox3d box;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    bool operator==(const Placed& other) const;
  };

  // A new view: everything is new in its first picture. `lamp_middle` is the point about which
  // shadows matter, `lamp_reach` how far about it, in the lamp's projection.
  void Start(const Projection& sight, int width, int height, const Projection& lamp,
             const Eigen::Vector3d& lamp_middle, double lamp_reach);

  // The next picture: where the pieces' parts are now.
  void Next(const std::vector<std::vector<Placed>>& pieces);

  bool everything() const { return everything_; }
  // Whether a moved piece may be seen in the pixel now, or at its upper left corner.
  bool Covers(int x, int y) const { return seen_[sight_.Cell(x + 1, y + 1)] != 0; }
  // Whether what a ray met, or its light, may be different now.
  bool Touches(const Trail& trail) const {
    return (trail.piece >= 0 && moved_[trail.piece] != 0) || shaded_[trail.lamp_cell] != 0 ||
           (!trail.lit && shaded_before_[trail.lamp_cell] != 0);
  }
  int LampCell(const Eigen::Vector3f& point) const { return lamp_.CellOf(point.cast<double>()); }

 private:
  using Mask = std::vector<std::uint8_t>;  // by cell

  static void Clear(const ViewCells& cells, Mask* mask);

  bool everything_ = true;
  bool started_ = false;
  ViewCells sight_, lamp_;
  std::vector<std::vector<Placed>> pieces_;  // in the last picture
  std::vector<std::uint8_t> moved_;
  Mask seen_, shaded_, shaded_before_;
};

// The boxes that hold a body's parts, in the body's frame.
std::vector<PictureChanges::Placed> PartBoxes(const VisualBody& body);

}  // namespace prospect::sim

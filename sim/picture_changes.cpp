#include "sim/picture_changes.h"

namespace prospect::sim {
namespace {

constexpr int kLampCells = 192;  // along each side: as fine as a small picture's pixels

}  // namespace

bool PictureChanges::Placed::operator==(const Placed& other) const {
  return pose.matrix() == other.pose.matrix() && box.min() == other.box.min() &&
         box.max() == other.box.max();
}

void PictureChanges::Start(const Projection& sight, int width, int height, const Projection& lamp,
                           const Eigen::Vector3d& lamp_middle, double lamp_reach) {
  // A frame of one cell takes what is beside the picture.
  const Eigen::Vector2d corner(1 + 2.0 / width, -1 - 2.0 / height);
  sight_ = ViewCells(sight, -corner, corner, width + 2, height + 2);
  const Eigen::Vector3d middle = lamp(lamp_middle);
  const Eigen::Vector2d at = middle.head<2>() / middle.z();
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(lamp_reach);
  lamp_ = ViewCells(lamp, at - reach, at + reach, kLampCells, kLampCells);
  pieces_.clear();
  started_ = false;
}

void PictureChanges::Clear(const ViewCells& cells, Mask* mask) {
  mask->assign(cells.size(), 0);
  (*mask)[ViewCells::kAlways] = 1;
}

void PictureChanges::Next(const std::vector<std::vector<Placed>>& pieces) {
  everything_ = !started_;
  started_ = true;
  if (!everything_) {
    Clear(sight_, &seen_);
    Clear(lamp_, &shaded_);
    Clear(lamp_, &shaded_before_);
    moved_.assign(pieces.size(), 0);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i] == pieces_[i]) continue;
      moved_[i] = 1;
      for (const Placed& part : pieces[i]) {
        sight_.Mark(part.box, part.pose, &seen_);
        lamp_.Mark(part.box, part.pose, &shaded_);
      }
      for (const Placed& part : pieces_[i]) lamp_.Mark(part.box, part.pose, &shaded_before_);
    }
  }
  pieces_ = pieces;
}

std::vector<PictureChanges::Placed> PartBoxes(const VisualBody& body) {
  std::vector<PictureChanges::Placed> boxes;
  for (const VisualPart& part : body) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3f& v : part.mesh.vertices) box.extend(v.cast<double>());
    boxes.push_back({box});
  }
  return boxes;
}

}  // namespace prospect::sim

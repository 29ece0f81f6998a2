#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace prospect::sim {

// Places as seen from one point, or from far away along one direction.
class Projection {
 public:
  // From `eye`: a point at depth d along `forward` is at (x, y) if it is x * d * `right` + y * d *
  // `up` off the line. The three stand at right angles, `forward` has length 1.
  static Projection Perspective(const Eigen::Vector3d& eye, const Eigen::Vector3d& forward,
                                const Eigen::Vector3d& right, const Eigen::Vector3d& up);
  // From far away, where `towards` (length 1) points to.
  static Projection Parallel(const Eigen::Vector3d& towards);

  // x, y and depth of a point; x and y are still to be divided by the depth, which is 1 if
  // parallel.
  Eigen::Vector3d operator()(const Eigen::Vector3d& point) const {
    return matrix_.leftCols<3>() * point + matrix_.col(3);
  }

 private:
  Eigen::Matrix<double, 3, 4> matrix_ = Eigen::Matrix<double, 3, 4>::Zero();
};

// Cells of a view that something may cover: a mask that may say too much, never too little. Cells
// at the edges stand for all that is beyond, too. Plain data.
class ViewCells {
 public:
  static constexpr int kNever = 0;   // a cell that nothing covers
  static constexpr int kAlways = 1;  // one that is always covered: of what is not before the eye

  ViewCells() = default;
  // Cells of `low` to `high` in the projection.
  ViewCells(const Projection& projection, const Eigen::Vector2d& low, const Eigen::Vector2d& high,
            int columns, int rows);

  int size() const { return columns_ * rows_ + 2; }
  int Cell(int column, int row) const { return 2 + row * columns_ + column; }
  int CellOf(const Eigen::Vector3d& point) const;

  // Marks the cells that a box placed at `pose` may cover.
  void Mark(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& pose,
            std::vector<std::uint8_t>* mask) const;

 private:
  void MarkHull(const std::vector<Eigen::Vector2d>& points, std::vector<std::uint8_t>* mask) const;

  Projection projection_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero(), scale_ = Eigen::Vector2d::Zero();
  int columns_ = 0, rows_ = 0;
};

}  // namespace prospect::sim

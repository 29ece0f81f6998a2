#include "sim/view_cells.h"

#include <algorithm>
#include <array>
#include <limits>

namespace prospect::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNear = 1e-3;   // m before the eye: what is nearer is not seen
constexpr double kSlack = 0.02;  // of a cell, against rounding
constexpr double kInfinity = std::numeric_limits<double>::infinity();

int Clamped(double at, int count) {
  return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
}

// What a hull reaches to in a row of cells.
struct Reach {
  double left = kInfinity, right = -kInfinity;
};

}  // namespace

Projection Projection::Perspective(const Vector3d& eye, const Vector3d& forward,
                                   const Vector3d& right, const Vector3d& up) {
  Projection projection;
  projection.matrix_.row(0) << right.transpose() / right.squaredNorm(), 0;
  projection.matrix_.row(1) << up.transpose() / up.squaredNorm(), 0;
  projection.matrix_.row(2) << forward.transpose(), 0;
  projection.matrix_.col(3) = -(projection.matrix_.leftCols<3>() * eye);
  return projection;
}

Projection Projection::Parallel(const Vector3d& towards) {
  const Vector3d right = towards.unitOrthogonal();
  Projection projection;
  projection.matrix_.row(0) << right.transpose(), 0;
  projection.matrix_.row(1) << towards.cross(right).transpose(), 0;
  projection.matrix_.row(2) << 0, 0, 0, 1;
  return projection;
}

ViewCells::ViewCells(const Projection& projection, const Vector2d& low, const Vector2d& high,
                     int columns, int rows)
    : projection_(projection),
      low_(low),
      scale_(Vector2d(columns, rows).cwiseQuotient(high - low)),
      columns_(columns),
      rows_(rows) {}

int ViewCells::CellOf(const Vector3d& point) const {
  const Vector3d seen = projection_(point);
  if (seen.z() < kNear) return kAlways;
  const Vector2d at = (seen.head<2>() / seen.z() - low_).cwiseProduct(scale_);
  return Cell(Clamped(at.x(), columns_), Clamped(at.y(), rows_));
}

void ViewCells::Mark(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& pose,
                     std::vector<std::uint8_t>* mask) const {
  std::array<Vector3d, 8> corners;
  for (int i = 0; i < 8; ++i) {
    corners[i] = projection_(pose * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  }
  std::vector<Vector2d> hull;  // of what is before the eye
  const auto put = [&](const Vector3d& seen) {
    hull.push_back((seen.head<2>() / seen.z() - low_).cwiseProduct(scale_));
  };
  for (int i = 0; i < 8; ++i) {
    if (corners[i].z() >= kNear) put(corners[i]);
    for (const int axis : {1, 2, 4}) {
      const Vector3d &a = corners[i], &b = corners[i | axis];
      if ((a.z() >= kNear) == (b.z() >= kNear)) continue;
      Vector3d between = a + (kNear - a.z()) / (b.z() - a.z()) * (b - a);
      between.z() = kNear;
      put(between);
    }
  }
  if (!hull.empty()) MarkHull(hull, mask);
}

// Lines between all pairs of points reach, row by row, as far as their hull.
void ViewCells::MarkHull(const std::vector<Vector2d>& points,
                         std::vector<std::uint8_t>* mask) const {
  double low = kInfinity, high = -kInfinity;
  for (const Vector2d& point : points) {
    low = std::min(low, point.y());
    high = std::max(high, point.y());
  }
  const int first = Clamped(low - kSlack, rows_), last = Clamped(high + kSlack, rows_);
  std::vector<Reach> reaches(last - first + 1);
  const auto line = [&](const Vector2d& a, const Vector2d& b) {  // a is not above b
    const double lean = a.y() < b.y() ? (b.x() - a.x()) / (b.y() - a.y()) : 0;
    const int end = Clamped(b.y() + kSlack, rows_);
    for (int row = Clamped(a.y() - kSlack, rows_); row <= end; ++row) {
      const double bottom = row == 0 ? -kInfinity : row - kSlack;
      const double top = row == rows_ - 1 ? kInfinity : row + 1 + kSlack;
      const double from = a.x() + (std::clamp(bottom, a.y(), b.y()) - a.y()) * lean;
      const double to = a.x() + (std::clamp(top, a.y(), b.y()) - a.y()) * lean;
      Reach& reach = reaches[row - first];
      reach.left = std::min({reach.left, from, to});
      reach.right = std::max({reach.right, from, to});
    }
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (points[i].y() < points[k].y() || i == k) line(points[i], points[k]);
    }
  }
  for (int row = first; row <= last; ++row) {
    const Reach& reach = reaches[row - first];
    const auto begin = mask->begin() + Cell(Clamped(reach.left - kSlack, columns_), row);
    std::fill(begin, mask->begin() + Cell(Clamped(reach.right + kSlack, columns_), row) + 1, 1);
  }
}

}  // namespace prospect::sim

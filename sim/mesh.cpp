#include "sim/mesh.h"

#include <cmath>

namespace prospect::sim {
namespace {

constexpr int kSides = 24;

// Rings of kSides vertices joined to a closed body: bottom ring, top ring, and the two centres.
Mesh Lathe(float foot_radius, float top_radius, float low, float high) {
  Mesh mesh;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * M_PI * i / kSides;
    const auto c = static_cast<float>(std::cos(angle));
    const auto s = static_cast<float>(std::sin(angle));
    mesh.vertices.emplace_back(foot_radius * c, foot_radius * s, low);
    mesh.vertices.emplace_back(top_radius * c, top_radius * s, high);
  }
  mesh.vertices.emplace_back(0.f, 0.f, low);
  mesh.vertices.emplace_back(0.f, 0.f, high);
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t a = 2 * i;
    const std::uint32_t b = 2 * ((i + 1) % kSides);
    mesh.triangles.push_back({a, b, a + 1});
    mesh.triangles.push_back({b, b + 1, a + 1});
    mesh.triangles.push_back({b, a, 2 * kSides});
    mesh.triangles.push_back({a + 1, b + 1, 2 * kSides + 1});
  }
  return mesh;
}

}  // namespace

VisualPart Box(const Eigen::Vector3f& centre, const Eigen::Vector3f& size, const Color& color) {
  VisualPart part;
  part.color = color;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3f sign(i & 1 ? .5f : -.5f, i & 2 ? .5f : -.5f, i & 4 ? .5f : -.5f);
    part.mesh.vertices.push_back(centre + sign.cwiseProduct(size));
  }
  part.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return part;
}

VisualPart Cylinder(const Eigen::Vector3f& centre, float radius, float length, const Color& color,
                    Axis axis) {
  VisualPart part{Lathe(radius, radius, -length / 2, length / 2), color};
  for (Eigen::Vector3f& v : part.mesh.vertices) {
    if (axis == Axis::kY) v = Eigen::Vector3f(v.x(), -v.z(), v.y());
    v += centre;
  }
  return part;
}

VisualPart Frustum(const Eigen::Vector3f& base, float foot_radius, float top_radius, float height,
                   const Color& color) {
  VisualPart part{Lathe(foot_radius, top_radius, 0, height), color};
  for (Eigen::Vector3f& v : part.mesh.vertices) v += base;
  return part;
}

VisualBody Placed(const VisualBody& body, double x, double y, double yaw) {
  const auto c = static_cast<float>(std::cos(yaw));
  const auto s = static_cast<float>(std::sin(yaw));
  const Eigen::Vector3f shift(static_cast<float>(x), static_cast<float>(y), 0);
  VisualBody placed = body;
  for (VisualPart& part : placed) {
    for (Eigen::Vector3f& v : part.mesh.vertices) {
      v = Eigen::Vector3f(c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()) + shift;
    }
  }
  return placed;
}

}  // namespace prospect::sim

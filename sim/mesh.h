#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace prospect::sim {

// Shapes for the camera: triangles of one colour, in the frame of the body they belong to (m).

using Color = Eigen::Vector3f;  // red, green, blue, 0..1

struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct VisualPart {
  Mesh mesh;
  Color color = Color(1, 1, 1);
};

// What moves as one piece.
using VisualBody = std::vector<VisualPart>;

enum class Axis { kY, kZ };

// A box with its centre and full sizes along the axes.
VisualPart Box(const Eigen::Vector3f& centre, const Eigen::Vector3f& size, const Color& color);

// A cylinder (24 sides) about `axis` with its centre, radius and full length.
VisualPart Cylinder(const Eigen::Vector3f& centre, float radius, float length, const Color& color,
                    Axis axis = Axis::kZ);

// An upright frustum standing on `base`: radii at its foot and top.
VisualPart Frustum(const Eigen::Vector3f& base, float foot_radius, float top_radius, float height,
                   const Color& color);

// `body` turned by yaw (rad) about z and then moved by (x, y).
VisualBody Placed(const VisualBody& body, double x, double y, double yaw);

}  // namespace prospect::sim

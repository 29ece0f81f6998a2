// The camera's view of a scene description: shapes become triangles.

#include <cmath>

#include "sim/scene_camera.h"

namespace prospect::sim {
namespace {

constexpr float kTableHalf = 4.0f;  // m
constexpr int kRings = 8;
constexpr int kSegments = 24;

VisualPart Moved(VisualPart part, const Eigen::Isometry3d& pose) {
  const Eigen::Isometry3f to = pose.cast<float>();
  for (Eigen::Vector3f& v : part.mesh.vertices) v = to * v;
  return part;
}

// A sphere cut in half and drawn `length` apart along z: a capsule, or a sphere with length 0.
VisualPart Capsule(double radius, double length, const Color& color) {
  VisualPart part;
  part.color = color;
  for (int ring = 0; ring <= kRings; ++ring) {
    const double polar = M_PI * ring / kRings;
    const double z = radius * std::cos(polar) + (2 * ring <= kRings ? length : -length) / 2;
    for (int i = 0; i < kSegments; ++i) {
      const double angle = 2 * M_PI * i / kSegments;
      part.mesh.vertices.push_back(Eigen::Vector3d(radius * std::sin(polar) * std::cos(angle),
                                                   radius * std::sin(polar) * std::sin(angle), z)
                                       .cast<float>());
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      const std::uint32_t a = ring * kSegments + i;
      const std::uint32_t b = ring * kSegments + (i + 1) % kSegments;
      part.mesh.triangles.push_back({a, a + kSegments, b});
      part.mesh.triangles.push_back({b, a + kSegments, b + kSegments});
    }
  }
  return part;
}

VisualPart PartOf(const ShapeDescription& shape) {
  const Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  switch (shape.kind) {
    case ShapeDescription::Kind::kBox:
      return Moved(Box(origin, shape.size.cast<float>(), shape.color), shape.pose);
    case ShapeDescription::Kind::kCylinder:
      return Moved(Cylinder(origin, static_cast<float>(shape.radius),
                            static_cast<float>(shape.length), shape.color),
                   shape.pose);
    case ShapeDescription::Kind::kCapsule:
      return Moved(Capsule(shape.radius, shape.length, shape.color), shape.pose);
    case ShapeDescription::Kind::kSphere:
      break;
  }
  return Moved(Capsule(shape.radius, 0, shape.color), shape.pose);
}

void Append(const BodyDescription& body, VisualBody* visual) {
  for (const ShapeDescription& shape : body.visual) visual->push_back(PartOf(shape));
}

VisualPart Table(const Color& color) {
  VisualPart table;
  table.color = color;
  for (const float x : {-kTableHalf, kTableHalf}) {
    for (const float y : {-kTableHalf, kTableHalf}) table.mesh.vertices.emplace_back(x, y, 0.f);
  }
  table.mesh.triangles = {{0, 2, 1}, {1, 2, 3}};
  return table;
}

}  // namespace

SceneVisuals TabletopVisuals(const TabletopDescription& scene) {
  SceneVisuals visuals;
  visuals.light = scene.light;
  visuals.still.push_back(Table(scene.table_color));
  for (const ShapeDescription& shape : scene.arm.foot.visual) {
    ShapeDescription placed = shape;
    placed.pose = scene.arm.base * shape.pose;
    visuals.still.push_back(PartOf(placed));
  }
  for (const BodyDescription& link : scene.arm.links) {
    visuals.moving.emplace_back();
    Append(link, &visuals.moving.back());
  }
  Append(scene.gripper.palm, &visuals.moving.back());
  for (int finger = 0; finger < 2; ++finger) {
    visuals.moving.emplace_back();
    Append(scene.gripper.finger, &visuals.moving.back());
  }
  for (const BodyDescription& block : scene.blocks) {
    visuals.moving.emplace_back();
    Append(block, &visuals.moving.back());
  }
  visuals.moving.emplace_back();
  Append(scene.obstacle, &visuals.moving.back());
  return visuals;
}

}  // namespace prospect::sim

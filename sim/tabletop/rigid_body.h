#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sim/ode_world.h"
#include "sim/tabletop/scene_description.h"

namespace prospect::sim {

// A shape that can collide.
struct CollisionShape {
  dGeomID geom = nullptr;
  dBodyID body = nullptr;
  double radius = 0;    // of the sphere about the shape's centre that holds it
  double friction = 0;  // of its surface
};

// An ODE body made of one or more descriptions that share a frame (a link and what is bolted to
// it). ODE puts a body's origin at its centre of mass; here a pose is always that of the
// description's frame. Owns body and geoms; the world must outlive it.
class RigidBody {
 public:
  RigidBody(OdeWorld* world, const std::vector<const BodyDescription*>& parts);
  ~RigidBody();
  RigidBody(const RigidBody&) = delete;
  RigidBody& operator=(const RigidBody&) = delete;

  dBodyID id() const { return body_; }

  // One entry a collision shape, in the order of the descriptions.
  const std::vector<CollisionShape>& shapes() const { return shapes_; }

  Eigen::Isometry3d frame() const;

  // Puts it there, at rest.
  void Place(const Eigen::Isometry3d& frame);

  // Kinetic plus potential energy (J) under `gravity`.
  double Energy(double gravity) const;

 private:
  dBodyID body_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();  // of mass, in the frame
  std::vector<CollisionShape> shapes_;
};

}  // namespace prospect::sim

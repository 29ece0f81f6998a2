#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "sim/arm/ur_kinematics.h"
#include "sim/mesh.h"

namespace prospect::sim {

// What a table-top scene is made of, as its file says it (config/scenes/*.yaml): an arm with a
// gripper, things that are free to move, cameras and a lamp. Physics and camera both read this.
// Plain data, metres, kilograms, radians.

struct ShapeDescription {
  enum class Kind { kBox, kCylinder, kCapsule, kSphere };
  Kind kind = Kind::kBox;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  // box: full sizes
  double radius = 0;                               // all others
  double length = 0;  // cylinder: full length; capsule: between the centres of its ends; along z
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // in the body's frame
  Color color = Color(1, 1, 1);

  // Of the sphere about the shape's centre that holds it.
  double bounding_radius() const;
};

struct BodyDescription {
  std::string name;
  double mass = 0;                                   // > 0 for what moves
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // of mass, in the body's frame
  // About the centre of mass, along the body's axes; zero: that of the first collision shape.
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();
  double friction = 0.5;
  std::vector<ShapeDescription> visual;
  std::vector<ShapeDescription> collision;
};

// An arm of Universal Robots' geometry.
struct ArmDescription {
  std::string name;
  UrLengths lengths;
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();  // frame 0 in the world
  JointVector position_limit = {};                         // rad either side of zero
  JointVector speed_limit = {};                            // rad/s
  JointVector torque_limit = {};                           // N m
  BodyDescription foot;                                    // stands still, in frame 0
  std::array<BodyDescription, 6> links;                    // link i in frame i + 1
};

// Two fingers that slide along the flange's y, opposite to each other.
struct GripperDescription {
  std::string name;
  double grasp_depth = 0;  // of the grasp frame along the flange's z
  double opening = 0;      // between the pads, at most
  double speed = 0;        // of each finger (m/s)
  double force = 0;        // on what is held (N)
  BodyDescription palm;    // in the flange's frame, fixed to it
  BodyDescription finger;  // in the finger's frame: y points away from the other finger
};

struct PhysicsDescription {
  double step = 0.004;
  double gravity = 9.81;
  double erp = 0.2;
  double cfm = 1e-6;
  double contact_cfm = 1e-4;  // of contacts' normals
  double surface_layer = 0.0005;
  double correcting_speed = 0.1;
  int contacts = 4;
  double sleep_after = 0.1;
  double sleep_speed = 0.004;
  double sleep_turn = 0.04;
};

struct CameraDescription {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  double fov = 0.7;  // vertical (rad)
};

struct LightDescription {
  Eigen::Vector3d towards = Eigen::Vector3d::UnitZ();  // unit vector to the lamp
  double ambient = 0.4;  // share of the light that comes from all sides
  Color sky = Color(0.7f, 0.76f, 0.82f);
};

struct TabletopDescription {
  PhysicsDescription physics;
  double table_friction = 1;
  Color table_color = Color(0.8f, 0.8f, 0.8f);
  LightDescription light;
  std::map<std::string, CameraDescription> cameras;  // "robot" is the one the networks see
  ArmDescription arm;
  GripperDescription gripper;
  std::vector<BodyDescription> blocks;
  BodyDescription obstacle;
};

}  // namespace prospect::sim

#include "sim/tabletop/scene_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/hash.h"
#include "base/yaml_keys.h"

namespace prospect::sim {
namespace {

constexpr double kHuge = 1e6;

using Colors = std::map<std::string, Color>;

Color ColorFrom(const std::vector<double>& rgb) {
  return Color(static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2]));
}

Colors ReadColors(const YamlReader& yaml) {
  Colors colors;
  for (const auto& entry : yaml.node()) {
    const std::string name = entry.first.as<std::string>();
    colors[name] = ColorFrom(yaml.Numbers(name, 3));
  }
  return colors;
}

Color NamedColor(const YamlReader& yaml, const std::string& key, const Colors& colors) {
  const auto found = colors.find(yaml.Text(key));
  if (found == colors.end()) yaml.Fail(key, "must be one of the colours above");
  return found->second;
}

// Brings the shape's own z to the axis named.
Eigen::Matrix3d AxisTurn(const YamlReader& yaml) {
  const std::string axis = yaml.Has("axis") ? yaml.Text("axis") : "z";
  if (axis == "z") return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d turn;
  if (axis == "x") {
    turn << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  } else if (axis == "y") {
    turn << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  } else {
    yaml.Fail("axis", "must be x, y or z");
  }
  return turn;
}

Eigen::Matrix3d FromRpy(const Eigen::Vector3d& rpy) {
  return (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

void ReadRound(const YamlReader& yaml, const std::string& key, ShapeDescription* shape) {
  const std::vector<double> sizes = yaml.Numbers(key, 2);
  shape->radius = sizes[0];
  shape->length = sizes[1];
  if (!(shape->radius > 0 && shape->length > 0)) yaml.Fail(key, "must be two sizes above 0");
}

void ReadForm(const YamlReader& yaml, ShapeDescription* shape) {
  if (yaml.Has("box")) {
    shape->kind = ShapeDescription::Kind::kBox;
    shape->size = yaml.Vector("box");
    if (!(shape->size.minCoeff() > 0)) yaml.Fail("box", "must be three sizes above 0");
  } else if (yaml.Has("cylinder")) {
    shape->kind = ShapeDescription::Kind::kCylinder;
    ReadRound(yaml, "cylinder", shape);
  } else if (yaml.Has("capsule")) {
    shape->kind = ShapeDescription::Kind::kCapsule;
    ReadRound(yaml, "capsule", shape);
  } else if (yaml.Has("sphere")) {
    shape->kind = ShapeDescription::Kind::kSphere;
    shape->radius = yaml.Number("sphere", 1e-6, kHuge);
  } else {
    yaml.Fail("shape", "must be a box, cylinder, capsule or sphere");
  }
}

ShapeDescription ReadShape(const YamlReader& yaml, const Colors& colors) {
  yaml.Only({"box", "cylinder", "capsule", "sphere", "at", "axis", "rpy", "color"});
  ShapeDescription shape;
  ReadForm(yaml, &shape);
  shape.pose.translation() = yaml.VectorOr("at", Eigen::Vector3d::Zero());
  shape.pose.linear() = FromRpy(yaml.VectorOr("rpy", Eigen::Vector3d::Zero())) * AxisTurn(yaml);
  if (yaml.Has("color")) shape.color = NamedColor(yaml, "color", colors);
  return shape;
}

std::vector<ShapeDescription> ReadShapes(const YamlReader& yaml, const std::string& key,
                                         const Colors& colors) {
  std::vector<ShapeDescription> shapes;
  if (!yaml.Has(key)) return shapes;
  if (!yaml.node()[key].IsSequence()) yaml.Fail(key, "must be a list of shapes");
  for (const YAML::Node& node : yaml.node()[key]) {
    const std::string path = yaml.path() + "." + key + "[" + std::to_string(shapes.size()) + "]";
    shapes.push_back(ReadShape(YamlReader(node, path), colors));
  }
  return shapes;
}

BodyDescription ReadBody(const YamlReader& yaml, const Colors& colors, bool moves) {
  yaml.Only({"name", "mass", "center", "inertia", "friction", "visual", "collision", "both"});
  BodyDescription body;
  if (moves) {
    body.name = yaml.Text("name");
    body.mass = yaml.Number("mass", 1e-3, 1e3);
  }
  body.center = yaml.VectorOr("center", Eigen::Vector3d::Zero());
  body.inertia = yaml.VectorOr("inertia", Eigen::Vector3d::Zero());
  if (yaml.Has("friction")) body.friction = yaml.Number("friction", 0, 10);
  body.visual = ReadShapes(yaml, "visual", colors);
  body.collision = ReadShapes(yaml, "collision", colors);
  for (const ShapeDescription& shape : ReadShapes(yaml, "both", colors)) {
    body.visual.push_back(shape);
    body.collision.push_back(shape);
  }
  const bool some_inertia = body.inertia.minCoeff() > 0;
  if (moves && !some_inertia && body.collision.empty()) {
    yaml.Fail("inertia", "must be three numbers above 0, or a collision shape must tell it");
  }
  return body;
}

JointVector ReadJoints(const YamlReader& yaml, const std::string& key) {
  JointVector joints;
  const std::vector<double> values = yaml.Numbers(key, 6);
  std::copy(values.begin(), values.end(), joints.begin());
  if (*std::min_element(joints.begin(), joints.end()) <= 0) yaml.Fail(key, "must be above 0");
  return joints;
}

ArmDescription ReadArm(const YamlReader& yaml, const Colors& colors) {
  yaml.Only(
      {"name", "dh", "base", "position_limit", "speed_limit", "torque_limit", "foot", "links"});
  ArmDescription arm;
  arm.name = yaml.Text("name");
  const YamlReader dh = yaml.At("dh");
  dh.Only({"d1", "a2", "a3", "d4", "d5", "d6"});
  const auto length = [&dh](const char* key) { return dh.Number(key, -5, 5); };
  arm.lengths = {length("d1"), length("a2"), length("a3"),
                 length("d4"), length("d5"), length("d6")};
  const YamlReader base = yaml.At("base");
  arm.base.translation() = base.Vector("at");
  arm.base.linear() = FromRpy({0, 0, base.Number("yaw", -7, 7)});
  arm.position_limit = ReadJoints(yaml, "position_limit");
  arm.speed_limit = ReadJoints(yaml, "speed_limit");
  arm.torque_limit = ReadJoints(yaml, "torque_limit");
  arm.foot = ReadBody(yaml.At("foot"), colors, false);
  const YAML::Node links = yaml.node()["links"];
  if (!links.IsSequence() || links.size() != 6) yaml.Fail("links", "must be six bodies");
  for (std::size_t i = 0; i < 6; ++i) {
    arm.links[i] = ReadBody({links[i], "arm.links[" + std::to_string(i) + "]"}, colors, true);
  }
  return arm;
}

GripperDescription ReadGripper(const YamlReader& yaml, const Colors& colors) {
  yaml.Only({"name", "grasp_depth", "opening", "speed", "force", "palm", "finger"});
  GripperDescription gripper;
  gripper.name = yaml.Text("name");
  gripper.grasp_depth = yaml.Number("grasp_depth", 0.01, 1);
  gripper.opening = yaml.Number("opening", 0.005, 1);
  gripper.speed = yaml.Number("speed", 1e-3, 5);
  gripper.force = yaml.Number("force", 0.1, 1000);
  gripper.palm = ReadBody(yaml.At("palm"), colors, true);
  gripper.finger = ReadBody(yaml.At("finger"), colors, true);
  return gripper;
}

PhysicsDescription ReadPhysics(const YamlReader& yaml) {
  yaml.Only({"step", "gravity", "erp", "cfm", "contact_cfm", "surface_layer", "correcting_speed",
             "contacts", "sleep_after", "sleep_speed", "sleep_turn"});
  PhysicsDescription physics;
  physics.step = yaml.Number("step", 1e-4, 0.01);
  physics.gravity = yaml.Number("gravity", 0, 30);
  physics.erp = yaml.Number("erp", 0.01, 1);
  physics.cfm = yaml.Number("cfm", 0, 1e-2);
  physics.contact_cfm = yaml.Number("contact_cfm", 0, 1e-2);
  physics.surface_layer = yaml.Number("surface_layer", 0, 0.01);
  physics.correcting_speed = yaml.Number("correcting_speed", 1e-3, 10);
  physics.contacts = yaml.Integer("contacts", 1, 16);
  physics.sleep_after = yaml.Number("sleep_after", 0, 10);
  physics.sleep_speed = yaml.Number("sleep_speed", 0, 1);
  physics.sleep_turn = yaml.Number("sleep_turn", 0, 10);
  return physics;
}

std::map<std::string, CameraDescription> ReadCameras(const YamlReader& yaml) {
  std::map<std::string, CameraDescription> cameras;
  for (const auto& entry : yaml.node()) {
    const std::string name = entry.first.as<std::string>();
    const YamlReader one = yaml.At(name);
    one.Only({"eye", "target", "fov_degrees"});
    CameraDescription& camera = cameras[name];
    camera.eye = one.Vector("eye");
    camera.target = one.Vector("target");
    camera.fov = one.Number("fov_degrees", 1, 170) * M_PI / 180;
    if ((camera.target - camera.eye).norm() < 1e-3) one.Fail("target", "must not be the eye");
  }
  if (!cameras.contains("robot")) yaml.Fail("robot", "is missing: the camera that is observed");
  return cameras;
}

LightDescription ReadLight(const YamlReader& yaml, const Colors& colors) {
  yaml.Only({"towards", "ambient", "sky"});
  LightDescription light;
  light.towards = yaml.Vector("towards");
  if (light.towards.z() <= 0) yaml.Fail("towards", "must point up");
  light.towards.normalize();
  light.ambient = yaml.Number("ambient", 0, 1);
  light.sky = NamedColor(yaml, "sky", colors);
  return light;
}

std::vector<BodyDescription> ReadBlocks(const YamlReader& root, const Colors& colors) {
  std::vector<BodyDescription> blocks;
  const YAML::Node list = root.node()["blocks"];
  if (!list.IsSequence() || list.size() == 0) root.Fail("blocks", "must be a list of bodies");
  for (std::size_t i = 0; i < list.size(); ++i) {
    blocks.push_back(ReadBody({list[i], "blocks[" + std::to_string(i) + "]"}, colors, true));
    if (blocks.back().collision.empty()) {
      root.Fail("blocks[" + std::to_string(i) + "]", "must have a collision shape");
    }
  }
  return blocks;
}

}  // namespace

double ShapeDescription::bounding_radius() const {
  switch (kind) {
    case Kind::kBox:
      return size.norm() / 2;
    case Kind::kCylinder:
      return std::hypot(radius, length / 2);
    case Kind::kCapsule:
      return radius + length / 2;
    case Kind::kSphere:
      return radius;
  }
  return 0;
}

YamlReader OpenSceneFile(const std::string& path) {
  try {
    const YAML::Node scene =
        path.empty() ? YAML::Load(DefaultStackingScene()) : YAML::LoadFile(path);
    const std::string twice = base::KeyTwice(scene);
    if (!twice.empty()) {
      throw SceneFileError(path + ": names '" + twice +
                           "' twice, and which one counts is chance: leave one");
    }
    return YamlReader(scene, "");
  } catch (const YAML::Exception& error) {
    throw SceneFileError((path.empty() ? "scene" : path) +
                         ": cannot be read as YAML: " + error.what());
  }
}

TabletopDescription ReadTabletop(const YamlReader& root) {
  const Colors colors = ReadColors(root.At("colors"));
  TabletopDescription scene;
  scene.physics = ReadPhysics(root.At("physics"));
  scene.table_friction = root.At("table").Number("friction", 0, 10);
  scene.table_color = NamedColor(root.At("table"), "color", colors);
  scene.light = ReadLight(root.At("light"), colors);
  scene.cameras = ReadCameras(root.At("cameras"));
  scene.arm = ReadArm(root.At("arm"), colors);
  scene.gripper = ReadGripper(root.At("gripper"), colors);
  scene.blocks = ReadBlocks(root, colors);
  scene.obstacle = ReadBody(root.At("obstacle"), colors, true);
  if (scene.obstacle.collision.empty()) root.Fail("obstacle", "must have a collision shape");
  return scene;
}

std::string SceneHash(const YamlReader& root, int revision) {
  const std::string text = std::to_string(revision) + "\n" + YAML::Dump(root.node());
  return base::HexText(base::HashText(text));
}

}  // namespace prospect::sim

#include "sim/tabletop/rigid_body.h"

namespace prospect::sim {
namespace {

dMass ShapeMass(const ShapeDescription& shape, double total) {
  dMass mass;
  switch (shape.kind) {
    case ShapeDescription::Kind::kBox:
      dMassSetBoxTotal(&mass, total, shape.size.x(), shape.size.y(), shape.size.z());
      break;
    case ShapeDescription::Kind::kCylinder:
      dMassSetCylinderTotal(&mass, total, 3, shape.radius, shape.length);
      break;
    case ShapeDescription::Kind::kCapsule:
      dMassSetCapsuleTotal(&mass, total, 3, shape.radius, shape.length);
      break;
    case ShapeDescription::Kind::kSphere:
      dMassSetSphereTotal(&mass, total, shape.radius);
      break;
  }
  return mass;
}

// Mass, centre and inertia of one description, in its frame.
dMass MassOf(const BodyDescription& body) {
  dMass mass;
  if (body.inertia.minCoeff() > 0) {
    const Eigen::Vector3d& i = body.inertia;
    dMassSetParameters(&mass, body.mass, 0, 0, 0, i.x(), i.y(), i.z(), 0, 0, 0);
  } else {
    mass = ShapeMass(body.collision.front(), body.mass);
  }
  dMassTranslate(&mass, body.center.x(), body.center.y(), body.center.z());
  return mass;
}

dGeomID MakeGeom(const ShapeDescription& shape) {
  switch (shape.kind) {
    case ShapeDescription::Kind::kBox:
      return dCreateBox(nullptr, shape.size.x(), shape.size.y(), shape.size.z());
    case ShapeDescription::Kind::kCylinder:
      return dCreateCylinder(nullptr, shape.radius, shape.length);
    case ShapeDescription::Kind::kCapsule:
      return dCreateCapsule(nullptr, shape.radius, shape.length);
    case ShapeDescription::Kind::kSphere:
      break;
  }
  return dCreateSphere(nullptr, shape.radius);
}

void ToMatrix3(const Eigen::Matrix3d& rotation, dMatrix3 out) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out[row * 4 + column] = rotation(row, column);
    out[row * 4 + 3] = 0;
  }
}

dGeomID AttachGeom(dBodyID body, const ShapeDescription& shape, const Eigen::Vector3d& center) {
  const dGeomID geom = MakeGeom(shape);
  dGeomSetBody(geom, body);
  const Eigen::Vector3d at = shape.pose.translation() - center;
  const bool turned = !shape.pose.linear().isIdentity(0);
  if (at.isZero(0) && !turned) return geom;  // without an offset ODE need not compute its pose
  dGeomSetOffsetPosition(geom, at.x(), at.y(), at.z());
  dMatrix3 rotation;
  ToMatrix3(shape.pose.linear(), rotation);
  dGeomSetOffsetRotation(geom, rotation);
  return geom;
}

}  // namespace

RigidBody::RigidBody(OdeWorld* world, const std::vector<const BodyDescription*>& parts)
    : body_(dBodyCreate(world->id())) {
  dMass mass;
  dMassSetZero(&mass);
  for (const BodyDescription* part : parts) {
    const dMass more = MassOf(*part);
    dMassAdd(&mass, &more);
  }
  center_ = Eigen::Vector3d(mass.c[0], mass.c[1], mass.c[2]);
  dMassTranslate(&mass, -mass.c[0], -mass.c[1], -mass.c[2]);
  mass.c[0] = mass.c[1] = mass.c[2] = 0;  // what rounding left
  dBodySetMass(body_, &mass);
  for (const BodyDescription* part : parts) {
    for (const ShapeDescription& shape : part->collision) {
      shapes_.push_back(
          {AttachGeom(body_, shape, center_), body_, shape.bounding_radius(), part->friction});
    }
  }
}

RigidBody::~RigidBody() {
  for (const CollisionShape& shape : shapes_) dGeomDestroy(shape.geom);
  dBodyDestroy(body_);
}

Eigen::Isometry3d RigidBody::frame() const {
  const dReal* p = dBodyGetPosition(body_);
  const dReal* r = dBodyGetRotation(body_);
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
  frame.translation() = Eigen::Vector3d(p[0], p[1], p[2]) - frame.linear() * center_;
  return frame;
}

void RigidBody::Place(const Eigen::Isometry3d& frame) {
  const Eigen::Vector3d at = frame * center_;
  const Eigen::Quaterniond turn(frame.linear());
  const dQuaternion q = {turn.w(), turn.x(), turn.y(), turn.z()};
  dBodySetPosition(body_, at.x(), at.y(), at.z());
  dBodySetQuaternion(body_, q);
  dBodySetLinearVel(body_, 0, 0, 0);
  dBodySetAngularVel(body_, 0, 0, 0);
  dBodySetForce(body_, 0, 0, 0);
  dBodySetTorque(body_, 0, 0, 0);
}

double RigidBody::Energy(double gravity) const {
  dMass mass;
  dBodyGetMass(body_, &mass);
  const dReal* v = dBodyGetLinearVel(body_);
  const dReal* w = dBodyGetAngularVel(body_);
  const Eigen::Isometry3d pose = frame();
  const Eigen::Vector3d turning = pose.linear().transpose() * Eigen::Vector3d(w[0], w[1], w[2]);
  double twice = mass.mass * Eigen::Vector3d(v[0], v[1], v[2]).squaredNorm();
  for (int i = 0; i < 3; ++i) twice += mass.I[i * 4 + i] * turning[i] * turning[i];
  return 0.5 * twice + mass.mass * gravity * dBodyGetPosition(body_)[2];
}

}  // namespace prospect::sim

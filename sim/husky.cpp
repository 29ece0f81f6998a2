#include "sim/husky.h"

#include <algorithm>
#include <cmath>

namespace prospect::sim {
namespace {

constexpr double kBodyLength = 0.9874, kBodyWidth = 0.5709, kBodyHeight = 0.2475;
constexpr double kBodyMass = 46.034, kWheelMass = 2.637;
constexpr double kWheelBase = 0.512, kTrack = 0.5708, kWheelWidth = 0.1143;
constexpr double kChassisHeight = 0.26;  // of the chassis' centre above the ground at rest (m)
constexpr double kAxleBelow = kChassisHeight - Husky::kWheelRadius;
constexpr double kGripAlong = 0.9, kGripAcross = 0.4;  // friction coefficients
constexpr double kMotorTorque = 40.0;                  // limit of one wheel's drive (N m)

double WheelX(int i) { return i < 2 ? kWheelBase / 2 : -kWheelBase / 2; }
double WheelY(int i) { return i % 2 == 0 ? kTrack / 2 : -kTrack / 2; }

double Toward(double from, double to, double most) {
  return from + std::clamp(to - from, -most, most);
}

}  // namespace

Footprint Husky::Hull() { return Footprint::Rectangle(kBodyLength, kTrack + kWheelWidth); }

Husky::Husky(OdeWorld* world) : world_(world) {
  MakeChassis();
  for (int i = 0; i < 4; ++i) MakeWheel(i);
}

Husky::~Husky() {
  dGeomDestroy(hull_);
  for (dJointID hinge : hinges_) dJointDestroy(hinge);
  for (dBodyID wheel : wheels_) dBodyDestroy(wheel);
  dBodyDestroy(chassis_);
}

void Husky::MakeChassis() {
  chassis_ = dBodyCreate(world_->id());
  dMass mass;
  dMassSetBoxTotal(&mass, kBodyMass, kBodyLength, kBodyWidth, kBodyHeight);
  dBodySetMass(chassis_, &mass);
  dBodySetPosition(chassis_, 0, 0, kChassisHeight);
  const Footprint hull = Hull();
  hull_ = dCreateBox(nullptr, 2 * hull.half_x, 2 * hull.half_y, kBodyHeight);
  dGeomSetBody(hull_, chassis_);
}

void Husky::MakeWheel(int i) {
  wheels_[i] = dBodyCreate(world_->id());
  dMass mass;
  dMassSetCylinderTotal(&mass, kWheelMass, 2, kWheelRadius, kWheelWidth);
  dBodySetMass(wheels_[i], &mass);
  dBodySetPosition(wheels_[i], WheelX(i), WheelY(i), kWheelRadius);
  dBodySetFiniteRotationMode(wheels_[i], 1);
  hinges_[i] = dJointCreateHinge(world_->id(), nullptr);
  dJointAttach(hinges_[i], chassis_, wheels_[i]);
  dJointSetHingeAnchor(hinges_[i], WheelX(i), WheelY(i), kWheelRadius);
  // With this direction a positive motor speed rolls the robot forward: ODE turns the first body
  // against the second.
  dJointSetHingeAxis(hinges_[i], 0, -1, 0);
  dJointSetHingeParam(hinges_[i], dParamFMax, kMotorTorque);
}

void Husky::Place(const Pose2& pose) {
  dQuaternion turn;
  dQFromAxisAndAngle(turn, 0, 0, 1, pose.yaw);
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  const auto put = [&](dBodyID body, double x, double y, double z) {
    dBodySetPosition(body, pose.x + c * x - s * y, pose.y + s * x + c * y, z);
    dBodySetQuaternion(body, turn);
    dBodySetLinearVel(body, 0, 0, 0);
    dBodySetAngularVel(body, 0, 0, 0);
    dBodySetForce(body, 0, 0, 0);
    dBodySetTorque(body, 0, 0, 0);
  };
  put(chassis_, 0, 0, kChassisHeight);
  for (int i = 0; i < 4; ++i) put(wheels_[i], WheelX(i), WheelY(i), kWheelRadius);
  ramp_ = {};
}

void Husky::Drive(const Twist2& command, double dt) {
  const double forward = std::clamp(command.forward, -kMaxSpeed, kMaxSpeed);
  const double turn = std::clamp(command.turn, -kMaxTurnRate, kMaxTurnRate);
  ramp_.forward = Toward(ramp_.forward, forward, kMaxAcceleration * dt);
  ramp_.turn = Toward(ramp_.turn, turn, kMaxTurnAcceleration * dt);
  SetWheelSpeeds();
  const dReal* rotation = dBodyGetRotation(chassis_);
  const double length = std::hypot(rotation[0], rotation[4]);
  const double heading[2] = {rotation[0] / length, rotation[4] / length};
  for (int i = 0; i < 4; ++i) AddContact(i, heading);
}

void Husky::SetWheelSpeeds() {
  for (int i = 0; i < 4; ++i) {
    const double rim = ramp_.forward - ramp_.turn * WheelY(i);
    dJointSetHingeParam(hinges_[i], dParamVel, rim / kWheelRadius);
  }
}

void Husky::AddContact(int i, const double forward[2]) {
  const dReal* centre = dBodyGetPosition(wheels_[i]);
  const double depth = kWheelRadius - centre[2];
  if (depth < 0) return;
  dContact contact = {};
  contact.surface.mode = dContactMu2 | dContactFDir1 | dContactApprox1 | dContactSoftCFM;
  contact.surface.mu = kGripAlong;
  contact.surface.mu2 = kGripAcross;
  contact.surface.soft_cfm = 1e-5;
  contact.geom.pos[0] = centre[0];
  contact.geom.pos[1] = centre[1];
  contact.geom.pos[2] = 0;
  contact.geom.normal[2] = 1;
  contact.geom.depth = depth;
  contact.fdir1[0] = forward[0];
  contact.fdir1[1] = forward[1];
  world_->AddGroundContact(wheels_[i], contact);
}

Pose2 Husky::pose() const {
  const dReal* position = dBodyGetPosition(chassis_);
  const dReal* rotation = dBodyGetRotation(chassis_);
  return {position[0], position[1], std::atan2(rotation[4], rotation[0])};
}

Twist2 Husky::velocity() const {
  const dReal* linear = dBodyGetLinearVel(chassis_);
  const dReal* rotation = dBodyGetRotation(chassis_);
  return {linear[0] * rotation[0] + linear[1] * rotation[4], dBodyGetAngularVel(chassis_)[2]};
}

bool Husky::Touches(dGeomID geom) const {
  dContactGeom contact;
  return dCollide(hull_, geom, 1, &contact, sizeof(contact)) > 0;
}

Eigen::Isometry3d Husky::ChassisPose() const {
  const dReal* p = dBodyGetPosition(chassis_);
  const dReal* r = dBodyGetRotation(chassis_);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(p[0], p[1], p[2]);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) pose.linear()(row, column) = r[row * 4 + column];
  }
  return pose;
}

VisualBody Husky::Visual() {
  const Color yellow(0.96f, 0.78f, 0.08f), black(0.07f, 0.07f, 0.08f), red(0.80f, 0.08f, 0.08f);
  VisualBody body;
  body.push_back(Box({0, 0, 0}, {0.80f, 0.44f, 0.25f}, yellow));
  body.push_back(Box({-0.14f, 0, 0.13f}, {0.36f, 0.26f, 0.05f}, black));  // sensor plate, aft
  body.push_back(Box({0.42f, 0, 0.0f}, {0.15f, 0.52f, 0.22f}, red));      // front bumper
  body.push_back(Box({-0.45f, 0, -0.02f}, {0.08f, 0.44f, 0.14f}, black));
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3f centre(static_cast<float>(WheelX(i)), static_cast<float>(WheelY(i)),
                                 static_cast<float>(-kAxleBelow));
    body.push_back(Cylinder(centre, static_cast<float>(kWheelRadius),
                            static_cast<float>(kWheelWidth), black, Axis::kY));
  }
  return body;
}

Husky::State Husky::Save() const {
  State state;
  state.bodies[0] = GetBodyState(chassis_);
  for (int i = 0; i < 4; ++i) state.bodies[i + 1] = GetBodyState(wheels_[i]);
  state.ramp = ramp_;
  return state;
}

void Husky::Restore(const State& state) {
  SetBodyState(chassis_, state.bodies[0]);
  for (int i = 0; i < 4; ++i) SetBodyState(wheels_[i], state.bodies[i + 1]);
  ramp_ = state.ramp;
}

}  // namespace prospect::sim

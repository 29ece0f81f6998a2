#include "sim/suturing/suturing_world.h"

#include <algorithm>
#include <cmath>

#include "sim/suturing/needle.h"

namespace prospect::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kContacts = 9;  // points of the wire that may touch the pad

BodyDescription HandBody(const SuturingParameters& p) {
  BodyDescription body;
  body.name = "hand";
  body.mass = p.hand_mass;
  body.inertia = Vector3d::Constant(p.hand_inertia);
  return body;
}

// A half circle of wire: its centre of mass is 2 r / pi from the arc's centre.
BodyDescription NeedleBody(const SuturingParameters& p) {
  const double r = p.needle_radius;
  const double out = 2 * r / M_PI;
  BodyDescription body;
  body.name = "needle";
  body.mass = p.needle_mass;
  body.center = Vector3d(0, out, 0);
  const double xx = p.needle_mass * (r * r / 2 - out * out);
  const double yy = p.needle_mass * r * r / 2;
  body.inertia = Vector3d(xx, yy, xx + yy);
  return body;
}

RigidBody MakeBody(OdeWorld* world, const BodyDescription& description) {
  return RigidBody(world, {&description});
}

dJointID MakeMotor(OdeWorld* world, dBodyID body, bool turning, double most) {
  const dJointID joint =
      turning ? dJointCreateAMotor(world->id(), nullptr) : dJointCreateLMotor(world->id(), nullptr);
  dJointAttach(joint, body, nullptr);
  if (turning) dJointSetAMotorMode(joint, dAMotorUser);
  turning ? dJointSetAMotorNumAxes(joint, 3) : dJointSetLMotorNumAxes(joint, 3);
  for (int i = 0; i < 3; ++i) {
    const dReal x = i == 0, y = i == 1, z = i == 2;
    turning ? dJointSetAMotorAxis(joint, i, 0, x, y, z) : dJointSetLMotorAxis(joint, i, 0, x, y, z);
  }
  for (int parameter : {dParamFMax, dParamFMax2, dParamFMax3}) {
    turning ? dJointSetAMotorParam(joint, parameter, most)
            : dJointSetLMotorParam(joint, parameter, most);
  }
  return joint;
}

Vector3d Limited(const Vector3d& value, double most) {
  const double size = value.norm();
  return size > most ? Vector3d(value * (most / size)) : value;
}

}  // namespace

SuturingWorld::SuturingWorld(const SuturingParameters& parameters)
    : p_(parameters),
      hands_{MakeBody(&world_, HandBody(p_)), MakeBody(&world_, HandBody(p_))},
      needle_(MakeBody(&world_, NeedleBody(p_))) {
  dWorldSetContactSurfaceLayer(world_.id(), 2e-5);
  for (int i = 0; i < 2; ++i) {
    dBodySetGravityMode(hands_[i].id(), 0);
    pushes_[i] = MakeMotor(&world_, hands_[i].id(), false, p_.hand_force);
    turns_[i] = MakeMotor(&world_, hands_[i].id(), true, p_.hand_torque);
  }
  dBodySetLinearDamping(needle_.id(), 0.004);
  dBodySetAngularDamping(needle_.id(), 0.02);
}

SuturingWorld::~SuturingWorld() {
  if (grip_ != nullptr) dJointDestroy(grip_);
  for (int i = 0; i < 2; ++i) {
    dJointDestroy(pushes_[i]);
    dJointDestroy(turns_[i]);
  }
}

void SuturingWorld::Place(const std::array<Isometry3d, 2>& hands, const Isometry3d& needle) {
  Hold(kNoHand);
  for (int i = 0; i < 2; ++i) hands_[i].Place(hands[i]);
  needle_.Place(needle);
  state_ = State();
}

void SuturingWorld::Steer(int hand, const Isometry3d& target, double opening) {
  const Isometry3d now = hands_[hand].frame();
  const double rate = p_.servo_gain / p_.step;
  const Vector3d push = Limited(rate * (target.translation() - now.translation()), p_.hand_speed);
  const Eigen::AngleAxisd error(target.linear() * now.linear().transpose());
  const Vector3d turn = Limited(rate * error.angle() * error.axis(), p_.hand_turn_speed);
  constexpr int kSpeeds[] = {dParamVel, dParamVel2, dParamVel3};
  for (int i = 0; i < 3; ++i) {
    dJointSetLMotorParam(pushes_[hand], kSpeeds[i], push[i]);
    dJointSetAMotorParam(turns_[hand], kSpeeds[i], turn[i]);
  }
  const double most = p_.jaw_speed * p_.step;
  double& jaws = state_.openings[hand];
  jaws += std::clamp(opening - jaws, -most, most);
}

void SuturingWorld::Step() {
  if (holder() == kNoHand) AddContacts();
  world_.Step(p_.step);
}

// The needle against the pad's top, z = 0.
void SuturingWorld::AddContacts() {
  const Isometry3d frame = needle();
  for (int i = 0; i < kContacts; ++i) {
    const Vector3d at = frame * NeedlePoint(p_, M_PI * i / (kContacts - 1));
    const double depth = p_.wire_radius - at.z();
    if (depth < 0) continue;
    dContact contact = {};
    contact.surface.mode = dContactApprox1 | dContactSoftCFM;
    contact.surface.mu = p_.friction;
    contact.surface.soft_cfm = 1e-4;
    contact.geom.pos[0] = at.x();
    contact.geom.pos[1] = at.y();
    contact.geom.normal[2] = 1;
    contact.geom.depth = depth;
    world_.AddGroundContact(needle_.id(), contact);
  }
}

void SuturingWorld::Hold(int hand) {
  state_.holder = hand;
  if (hand != kNoHand) {
    state_.hand_when_taken = GetBodyState(hands_[hand].id());
    state_.needle_when_taken = GetBodyState(needle_.id());
  }
  Join(hand);
}

void SuturingWorld::Join(int hand) {
  if (grip_ != nullptr) dJointDestroy(grip_);
  grip_ = nullptr;
  if (hand == kNoHand) return;
  grip_ = dJointCreateFixed(world_.id(), nullptr);
  dJointAttach(grip_, needle_.id(), hands_[hand].id());
  dJointSetFixed(grip_);
}

SuturingWorld::State SuturingWorld::Save() const {
  State state = state_;
  for (int i = 0; i < 2; ++i) state.bodies[i] = GetBodyState(hands_[i].id());
  state.bodies[2] = GetBodyState(needle_.id());
  return state;
}

void SuturingWorld::Restore(const State& state) {
  state_ = state;
  if (state.holder != kNoHand) {
    SetBodyState(hands_[state.holder].id(), state.hand_when_taken);
    SetBodyState(needle_.id(), state.needle_when_taken);
  }
  Join(state.holder);
  for (int i = 0; i < 2; ++i) SetBodyState(hands_[i].id(), state.bodies[i]);
  SetBodyState(needle_.id(), state.bodies[2]);
}

}  // namespace prospect::sim

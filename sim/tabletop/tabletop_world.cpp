#include "sim/tabletop/tabletop_world.h"

#include <algorithm>
#include <cmath>

namespace prospect::sim {
namespace {

constexpr int kMostContacts = 16;

bool SpheresMeet(const CollisionShape& a, const CollisionShape& b) {
  const dReal* p = dGeomGetPosition(a.geom);
  const dReal* q = dGeomGetPosition(b.geom);
  const double reach = a.radius + b.radius;
  const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
  return x * x + y * y + z * z < reach * reach;
}

}  // namespace

TabletopWorld::TabletopWorld(const TabletopDescription& scene)
    : physics_(scene.physics), arm_(&world_, scene.arm, scene.gripper), loose_(&world_, scene) {
  dWorldSetGravity(world_.id(), 0, 0, -physics_.gravity);
  dWorldSetERP(world_.id(), physics_.erp);
  dWorldSetCFM(world_.id(), physics_.cfm);
  dWorldSetContactSurfaceLayer(world_.id(), physics_.surface_layer);
  dWorldSetContactMaxCorrectingVel(world_.id(), physics_.correcting_speed);
  table_ = {dCreatePlane(nullptr, 0, 0, 1, 0), nullptr, 0, scene.table_friction};
  for (int i = 0; i < ArmChain::kBodies; ++i) {
    const auto& shapes = arm_.body(i).shapes();
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      const bool gripper = i >= 5 && (i > 5 || k >= scene.arm.links[5].collision.size());
      robot_shapes_.push_back({shapes[k], gripper ? Touches::Part::kGripper : Touches::Part::kArm,
                               ArmChain::IsFinger(i) ? i - 6 : -1});
    }
  }
  const auto n = static_cast<std::size_t>(loose_.size());
  touches_.by_robot.assign(n, 0);
  for (auto& finger : touches_.by_fingers) finger.assign(n, 0);
  touches_.stacked.assign(n * n, 0);
}

TabletopWorld::~TabletopWorld() { dGeomDestroy(table_.geom); }

void TabletopWorld::Step() {
  arm_.UpdateGripper(physics_.step);
  FindContacts();
  world_.Step(physics_.step);
  loose_.UpdateSleep(touches_.by_robot);
}

void TabletopWorld::FindContacts() {
  touches_.obstacle = touches_.table = Touches::Part::kNone;
  std::fill(touches_.by_robot.begin(), touches_.by_robot.end(), 0);
  for (auto& finger : touches_.by_fingers) std::fill(finger.begin(), finger.end(), 0);
  RobotAgainstLoose();
  LooseAgainstLoose();
  AgainstTable();
}

void TabletopWorld::RobotAgainstLoose() {
  for (const RobotShape& part : robot_shapes_) {
    for (int i = 0; i < loose_.size(); ++i) {
      for (const CollisionShape& shape : loose_.shapes(i)) {
        if (SpheresMeet(part.shape, shape) && Collide(part.shape, shape) > 0) NoteTouch(part, i);
      }
    }
  }
}

void TabletopWorld::NoteTouch(const RobotShape& part, int loose) {
  loose_.Wake(loose);
  touches_.by_robot[loose] = 1;
  if (part.finger >= 0) touches_.by_fingers[part.finger][loose] = 1;
  if (loose == loose_.obstacle() && touches_.obstacle == Touches::Part::kNone) {
    touches_.obstacle = part.part;
  }
}

// A sleeping pair keeps the touch it had when it fell asleep.
void TabletopWorld::LooseAgainstLoose() {
  const int n = loose_.size();
  for (int i = 0; i < n; ++i) {
    for (int k = i + 1; k < n; ++k) {
      if (loose_.asleep(i) && loose_.asleep(k)) continue;
      const bool touch = CollideLoose(i, k);
      touches_.stacked[i * n + k] = touches_.stacked[k * n + i] = touch;
      if (!touch) continue;
      if (loose_.asleep(i)) loose_.Wake(i);
      if (loose_.asleep(k)) loose_.Wake(k);
      if (k == loose_.obstacle() && touches_.Held(i) && touches_.obstacle == Touches::Part::kNone) {
        touches_.obstacle = Touches::Part::kHeldBlock;
      }
    }
  }
}

bool TabletopWorld::CollideLoose(int i, int k) {
  bool touch = false;
  for (const CollisionShape& a : loose_.shapes(i)) {
    for (const CollisionShape& b : loose_.shapes(k)) {
      if (SpheresMeet(a, b) && Collide(a, b) > 0) touch = true;
    }
  }
  return touch;
}

void TabletopWorld::AgainstTable() {
  for (int i = 0; i < loose_.size(); ++i) {
    if (loose_.asleep(i)) continue;
    for (const CollisionShape& shape : loose_.shapes(i)) {
      if (dGeomGetPosition(shape.geom)[2] < shape.radius) Collide(shape, table_);
    }
  }
  for (const RobotShape& part : robot_shapes_) {
    if (part.shape.body == arm_.body(0).id()) continue;  // the shoulder turns on its foot
    if (dGeomGetPosition(part.shape.geom)[2] >= part.shape.radius) continue;
    if (Collide(part.shape, table_) > 0) touches_.table = part.part;
  }
}

int TabletopWorld::Collide(const CollisionShape& a, const CollisionShape& b) {
  dContact contacts[kMostContacts];
  const int n = dCollide(a.geom, b.geom, physics_.contacts, &contacts[0].geom, sizeof(dContact));
  for (int i = 0; i < n; ++i) {
    dContact& contact = contacts[i];
    contact.surface = {};
    contact.surface.mode = dContactApprox1 | dContactSoftCFM;
    contact.surface.soft_cfm = physics_.contact_cfm;
    contact.surface.mu = std::sqrt(a.friction * b.friction);
    world_.AddContact(a.body, b.body, contact);
  }
  return n;
}

template <typename Visit>
void TabletopWorld::ForEachBody(Visit visit) const {
  for (int i = 0; i < ArmChain::kBodies; ++i) visit(arm_.body(i));
  for (int i = 0; i < loose_.size(); ++i) visit(loose_.body(i));
}

double TabletopWorld::Energy() const {
  double sum = 0;
  ForEachBody([&](const RigidBody& body) { sum += body.Energy(physics_.gravity); });
  return sum;
}

TabletopWorld::State TabletopWorld::Save() const {
  State state;
  ForEachBody([&](const RigidBody& body) { state.bodies.push_back(GetBodyState(body.id())); });
  state.sleep = loose_.Save();
  state.stacked = touches_.stacked;
  return state;
}

void TabletopWorld::Restore(const State& state) {
  auto next = state.bodies.begin();
  ForEachBody([&](const RigidBody& body) { SetBodyState(body.id(), *next++); });
  loose_.Restore(state.sleep);
  touches_.stacked = state.stacked;
}

}  // namespace prospect::sim

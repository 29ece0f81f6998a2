#include "sim/tabletop/loose_bodies.h"

#include <algorithm>
#include <cmath>

namespace prospect::sim {
namespace {

double Length(const dReal* v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace

LooseBodies::LooseBodies(OdeWorld* world, const TabletopDescription& scene)
    : physics_(scene.physics) {
  std::vector<const BodyDescription*> all;
  for (const BodyDescription& block : scene.blocks) all.push_back(&block);
  all.push_back(&scene.obstacle);
  for (const BodyDescription* one : all) {
    bodies_.push_back(std::make_unique<RigidBody>(world, std::vector<const BodyDescription*>{one}));
    double radius = 0;
    for (const ShapeDescription& shape : one->collision) {
      const double offset = (shape.pose.translation() - one->center).norm();
      radius = std::max(radius, offset + shape.bounding_radius());
    }
    radii_.push_back(radius);
  }
  asleep_.assign(bodies_.size(), 0);
  still_steps_.assign(bodies_.size(), 0);
  may_sleep_.assign(bodies_.size(), 0);
}

void LooseBodies::Place(int i, const Eigen::Isometry3d& frame) {
  bodies_[i]->Place(frame);
  asleep_[i] = 0;
  still_steps_[i] = 0;
  dBodyEnable(bodies_[i]->id());
}

double LooseBodies::speed(int i) const { return Length(dBodyGetLinearVel(bodies_[i]->id())); }

bool LooseBodies::Still(int i) const {
  return speed(i) < physics_.sleep_speed &&
         Length(dBodyGetAngularVel(bodies_[i]->id())) < physics_.sleep_turn;
}

bool LooseBodies::Close(int i, int k) const {
  const dReal* a = dBodyGetPosition(bodies_[i]->id());
  const dReal* b = dBodyGetPosition(bodies_[k]->id());
  const dReal apart[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return Length(apart) < radii_[i] + radii_[k];
}

void LooseBodies::Wake(int i) {
  still_steps_[i] = 0;
  if (!asleep_[i]) return;
  asleep_[i] = 0;
  dBodyEnable(bodies_[i]->id());
  for (int k = 0; k < size(); ++k) {
    if (asleep_[k] && Close(i, k)) Wake(k);
  }
}

void LooseBodies::UpdateSleep(const std::vector<char>& touched) {
  const int enough = static_cast<int>(std::lround(physics_.sleep_after / physics_.step));
  for (int i = 0; i < size(); ++i) {
    if (asleep_[i]) continue;
    still_steps_[i] = Still(i) && !touched[i] ? still_steps_[i] + 1 : 0;
    may_sleep_[i] = still_steps_[i] >= enough;
  }
  for (bool changed = true; changed;) {  // nobody sleeps close to one that is restless
    changed = false;
    for (int i = 0; i < size(); ++i) {
      if (asleep_[i] || !may_sleep_[i]) continue;
      for (int k = 0; k < size() && may_sleep_[i]; ++k) {
        if (k == i || asleep_[k] || may_sleep_[k] || !Close(i, k)) continue;
        may_sleep_[i] = 0;
        changed = true;
      }
    }
  }
  for (int i = 0; i < size(); ++i) {
    if (asleep_[i] || !may_sleep_[i]) continue;
    asleep_[i] = 1;
    dBodySetLinearVel(bodies_[i]->id(), 0, 0, 0);
    dBodySetAngularVel(bodies_[i]->id(), 0, 0, 0);
    dBodyDisable(bodies_[i]->id());
  }
}

void LooseBodies::Restore(const State& state) {
  asleep_ = state.asleep;
  still_steps_ = state.still_steps;
  for (int i = 0; i < size(); ++i) {
    if (asleep_[i]) {
      dBodyDisable(bodies_[i]->id());
    } else {
      dBodyEnable(bodies_[i]->id());
    }
  }
}

}  // namespace prospect::sim

#pragma once

#include <memory>
#include <vector>

#include "sim/tabletop/rigid_body.h"

namespace prospect::sim {

// What is free to move: the blocks, then the obstacle. Bodies that have lain still for a while
// sleep (they cost nothing) until woken; a body and what is close to it sleep and wake together, so
// that nothing hangs in the air when its support is taken.
class LooseBodies {
 public:
  LooseBodies(OdeWorld* world, const TabletopDescription& scene);

  int size() const { return static_cast<int>(bodies_.size()); }
  int obstacle() const { return size() - 1; }
  const RigidBody& body(int i) const { return *bodies_[i]; }
  const std::vector<CollisionShape>& shapes(int i) const { return bodies_[i]->shapes(); }

  // Of the sphere about body `i`'s centre that holds all its shapes.
  double radius(int i) const { return radii_[i]; }

  // Puts body `i` there, at rest and awake.
  void Place(int i, const Eigen::Isometry3d& frame);

  bool asleep(int i) const { return asleep_[i] != 0; }
  double speed(int i) const;  // m/s

  // Wakes body `i` and all that sleep close to it.
  void Wake(int i);

  // After a step: puts to sleep what has been still for long enough. touched[i]: the robot touches
  // body i.
  void UpdateSleep(const std::vector<char>& touched);

  // Sleep's part of a saved state; bodies are saved by whoever owns this.
  struct State {
    std::vector<char> asleep;
    std::vector<int> still_steps;
  };
  State Save() const { return {asleep_, still_steps_}; }
  void Restore(const State& state);

 private:
  bool Still(int i) const;
  bool Close(int i, int k) const;

  PhysicsDescription physics_;
  std::vector<std::unique_ptr<RigidBody>> bodies_;
  std::vector<double> radii_;
  std::vector<char> asleep_;
  std::vector<int> still_steps_;
  std::vector<char> may_sleep_;  // room for UpdateSleep
};

}  // namespace prospect::sim

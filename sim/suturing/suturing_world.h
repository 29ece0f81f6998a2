#pragma once

#include <Eigen/Geometry>
#include <array>

#include "sim/ode_world.h"
#include "sim/suturing/parameters.h"
#include "sim/tabletop/rigid_body.h"

namespace prospect::sim {

inline constexpr int kRightHand = 0;
inline constexpr int kLeftHand = 1;
inline constexpr int kNoHand = -1;

// The physics of the suturing scene. Three ODE bodies: two hands (an instrument's wrist and jaws)
// and the needle. A hand is driven by motors of limited force towards where the surgeon wants it.
// The needle obeys gravity and rests on the pad by contact. Jaws hold it by a fixed joint between
// the two bodies, made when they close about the wire and removed when they open: how the wire is
// clamped is not simulated. While it is held it passes through the tissue without resistance, and
// the hands do not collide. The thread has no part in the physics (sim/suturing/thread.h).
//
// A hand's frame: its origin is between the jaws' tips, z points from the wrist to the tips, the
// jaws open along x. One thread at a time.
class SuturingWorld {
 public:
  explicit SuturingWorld(const SuturingParameters& parameters);
  ~SuturingWorld();
  SuturingWorld(const SuturingWorld&) = delete;
  SuturingWorld& operator=(const SuturingWorld&) = delete;

  // Puts everything there, at rest, the needle in nobody's hand, the jaws shut.
  void Place(const std::array<Eigen::Isometry3d, 2>& hands, const Eigen::Isometry3d& needle);

  // Sets a hand's motors for the next Step: towards `target`, its jaws towards `opening` (rad).
  void Steer(int hand, const Eigen::Isometry3d& target, double opening);

  // One step of the physics.
  void Step();

  // The jaws of `hand` hold the needle as it is now, whoever held it before; the jaws of kNoHand:
  // it is free.
  void Hold(int hand);

  int holder() const { return state_.holder; }
  Eigen::Isometry3d hand(int i) const { return hands_[i].frame(); }
  Eigen::Isometry3d needle() const { return needle_.frame(); }
  double opening(int i) const { return state_.openings[i]; }

  struct State {
    std::array<BodyState, 3> bodies = {};
    std::array<double, 2> openings = {};
    int holder = kNoHand;
    // When the needle was taken: the joint's offset is made from them.
    BodyState hand_when_taken = {};
    BodyState needle_when_taken = {};
  };
  State Save() const;
  void Restore(const State& state);

 private:
  void Join(int hand);
  void AddContacts();

  const SuturingParameters& p_;
  OdeWorld world_;
  std::array<RigidBody, 2> hands_;
  RigidBody needle_;
  std::array<dJointID, 2> pushes_ = {};  // motors along x, y, z
  std::array<dJointID, 2> turns_ = {};   // motors about x, y, z
  dJointID grip_ = nullptr;              // null while nobody holds the needle
  State state_;                          // its bodies are filled in by Save only
};

}  // namespace prospect::sim

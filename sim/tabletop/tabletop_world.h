#pragma once

#include <memory>
#include <vector>

#include "sim/ode_world.h"
#include "sim/tabletop/arm_chain.h"
#include "sim/tabletop/loose_bodies.h"
#include "sim/tabletop/scene_description.h"

namespace prospect::sim {

// Who touched what during one step.
struct Touches {
  enum class Part { kNone, kArm, kGripper, kHeldBlock };
  Part obstacle = Part::kNone;      // what touched the obstacle first, in this order of parts
  Part table = Part::kNone;         // which part of the robot touched the table
  std::vector<char> by_robot;       // per loose body: the robot touches it
  std::vector<char> by_fingers[2];  // per loose body and finger
  std::vector<char> stacked;        // per pair of loose bodies i * size + k: they touch

  bool Held(int i) const { return by_fingers[0][i] != 0 && by_fingers[1][i] != 0; }
};

// A table with an arm and loose things on it, in one self-threaded ODE world. Shapes are asked for
// contacts pair by pair in a fixed order, so that a run is bit-repeatable; spheres about the shapes
// keep most pairs from being asked. The arm does not collide with itself.
//
// Threads: one at a time; a world may move to another thread between calls (call
// OdeWorld::PrepareThread there first).
class TabletopWorld {
 public:
  explicit TabletopWorld(const TabletopDescription& scene);
  ~TabletopWorld();
  TabletopWorld(const TabletopWorld&) = delete;
  TabletopWorld& operator=(const TabletopWorld&) = delete;

  ArmChain& arm() { return arm_; }
  const ArmChain& arm() const { return arm_; }
  LooseBodies& loose() { return loose_; }
  const LooseBodies& loose() const { return loose_; }
  double step() const { return physics_.step; }

  // One physics step. The touches are those of the step's beginning.
  void Step();
  const Touches& touches() const { return touches_; }

  // Of everything that moves (J).
  double Energy() const;

  // Exact state between two steps, motors' commands apart: whoever drives sets those again.
  struct State {
    std::vector<BodyState> bodies;
    LooseBodies::State sleep;
    std::vector<char> stacked;  // of sleeping pairs
  };
  State Save() const;
  void Restore(const State& state);

 private:
  // A shape of the robot.
  struct RobotShape {
    CollisionShape shape;
    Touches::Part part;
    int finger;  // 0 or 1, else -1
  };

  void FindContacts();
  void RobotAgainstLoose();
  void LooseAgainstLoose();
  bool CollideLoose(int i, int k);
  void AgainstTable();
  int Collide(const CollisionShape& a, const CollisionShape& b);
  void NoteTouch(const RobotShape& part, int loose);
  template <typename Visit>
  void ForEachBody(Visit visit) const;

  PhysicsDescription physics_;
  OdeWorld world_;
  ArmChain arm_;
  LooseBodies loose_;
  CollisionShape table_;
  std::vector<RobotShape> robot_shapes_;
  Touches touches_;
};

}  // namespace prospect::sim

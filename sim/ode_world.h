#pragma once

#include <ode/ode.h>

namespace prospect::sim {

// One ODE world with its own contacts and its own self-threaded stepping, so that worlds may live
// in several threads (ODE aborts the process when two threads step worlds without that). ODE itself
// is initialised once a process; every thread that uses a world calls PrepareThread first.
//
// There is no ODE space: whoever owns the bodies asks for the few pairs that matter in a fixed
// order, so that contacts, and with them the solver's rows, come in the same order in every run.
class OdeWorld {
 public:
  OdeWorld();
  ~OdeWorld();
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  // Allocates ODE's collision memory of the calling thread, once.
  static void PrepareThread();

  dWorldID id() const { return world_; }

  // Joins `body` to the static world by a contact that lasts for the next Step.
  void AddGroundContact(dBodyID body, const dContact& contact);

  // Joins two bodies by a contact that lasts for the next Step; its normal points into `first`.
  void AddContact(dBodyID first, dBodyID second, const dContact& contact);

  // One dWorldStep of `dt` seconds (exact Dantzig solver: no random order, no warm start).
  void Step(double dt);

 private:
  dWorldID world_;
  dJointGroupID contacts_;
  dThreadingImplementationID threading_;
};

// Exact state of a body: what dWorldStep reads and writes.
struct BodyState {
  dReal position[3];
  dReal quaternion[4];
  dReal rotation[12];
  dReal linear[3];
  dReal angular[3];
};

BodyState GetBodyState(dBodyID body);

// Puts the exact bits back. (ODE's setters normalise the quaternion, which may change its last
// bits.)
void SetBodyState(dBodyID body, const BodyState& state);

}  // namespace prospect::sim

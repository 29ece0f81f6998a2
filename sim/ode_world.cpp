#include "sim/ode_world.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <mutex>

namespace prospect::sim {
namespace {

// Where many contacts bear one load ODE's solver meets a zero pivot now and then, says "LCP
// internal error" and takes the solution it has. That is no news for whoever watches a terminal;
// all else is.
void Report(int number, const char* format, va_list arguments) {
  if (number == d_ERR_LCP) return;
  std::vfprintf(stderr, format, arguments);
  std::fputc('\n', stderr);
}

void InitOdeOnce() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetMessageHandler(&Report);
  });
}

}  // namespace

void OdeWorld::PrepareThread() {
  InitOdeOnce();
  thread_local const bool ready = dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  static_cast<void>(ready);
}

OdeWorld::OdeWorld() {
  PrepareThread();
  world_ = dWorldCreate();
  contacts_ = dJointGroupCreate(0);
  threading_ = dThreadingAllocateSelfThreadedImplementation();
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threading_),
                                       threading_);
  dWorldSetGravity(world_, 0, 0, -9.81);
  dWorldSetERP(world_, 0.2);
  dWorldSetCFM(world_, 1e-6);
  dWorldSetContactSurfaceLayer(world_, 0.001);
  dWorldSetContactMaxCorrectingVel(world_, 0.1);
  dWorldSetAutoDisableFlag(world_, 0);
}

OdeWorld::~OdeWorld() {
  dJointGroupDestroy(contacts_);
  dWorldDestroy(world_);
  dThreadingFreeImplementation(threading_);
}

void OdeWorld::AddGroundContact(dBodyID body, const dContact& contact) {
  AddContact(body, nullptr, contact);
}

void OdeWorld::AddContact(dBodyID first, dBodyID second, const dContact& contact) {
  dJointAttach(dJointCreateContact(world_, contacts_, &contact), first, second);
}

void OdeWorld::Step(double dt) {
  dWorldStep(world_, dt);
  dJointGroupEmpty(contacts_);
}

BodyState GetBodyState(dBodyID body) {
  BodyState state;
  std::copy_n(dBodyGetPosition(body), 3, state.position);
  std::copy_n(dBodyGetQuaternion(body), 4, state.quaternion);
  std::copy_n(dBodyGetRotation(body), 12, state.rotation);
  std::copy_n(dBodyGetLinearVel(body), 3, state.linear);
  std::copy_n(dBodyGetAngularVel(body), 3, state.angular);
  return state;
}

void SetBodyState(dBodyID body, const BodyState& state) {
  dBodySetPosition(body, state.position[0], state.position[1], state.position[2]);
  dBodySetQuaternion(body, state.quaternion);  // also tells the geoms that they moved
  // ODE hands out pointers into the body itself; writing through them skips the normalisation.
  std::copy_n(state.quaternion, 4, const_cast<dReal*>(dBodyGetQuaternion(body)));
  std::copy_n(state.rotation, 12, const_cast<dReal*>(dBodyGetRotation(body)));
  dBodySetLinearVel(body, state.linear[0], state.linear[1], state.linear[2]);
  dBodySetAngularVel(body, state.angular[0], state.angular[1], state.angular[2]);
  dBodySetForce(body, 0, 0, 0);
  dBodySetTorque(body, 0, 0, 0);
}

}  // namespace prospect::sim

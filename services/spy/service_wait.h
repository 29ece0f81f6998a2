#pragma once

#include <map>
#include <string>

#include "services/common/health_monitor.h"

namespace prospect::services {

/// How many of each service are wanted, or missing, by name: {"worker": 2}.
using ServiceCounts = std::map<std::string, int>;

/// Reads "simulator=1,model=1,worker=2"; a name alone means one.
/// @throws ExitError (kExitUsage) for anything else
ServiceCounts ParseServices(const std::string& text);

/// What of `wanted` is not there yet: alive, of this deployment, and in STATE_READY or STATE_BUSY.
ServiceCounts MissingServices(const ServiceCounts& wanted, const HealthMonitor& monitor);

/// "1 model, 2 worker", and the notes of live services that report a fault; for a message.
std::string DescribeMissing(const ServiceCounts& missing, const HealthMonitor& monitor);

/// Polls the bus until all are there. @throws ExitError: kExitTimeout naming what is missing after
/// `seconds`, kExitBusInUse when another deployment is heard, kExitInterrupted on a signal
void WaitForServices(Bus& bus, HealthMonitor& monitor, const ServiceCounts& wanted, double seconds);

/// Listens until something of a deployment is heard: a process's HEALTH or a robot's TASK. Says
/// that it waits when that takes more than a second. @throws ExitError: kExitServiceLost when
/// nothing is heard within `seconds`, kExitInterrupted on a signal
void RequireSomebody(Bus& bus, const HealthMonitor& monitor, double seconds);

/// Polls the bus until this instance says that it is at work, and returns what it said.
/// @throws ExitError: kExitServiceLost with its last word when it does not within `seconds`,
/// kExitInterrupted on a signal
health_t WaitForInstance(Bus& bus, const HealthMonitor& monitor, std::int64_t instance_id,
                         double seconds);

}  // namespace prospect::services

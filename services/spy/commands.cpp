#include "services/spy/commands.h"

#include <cstdio>
#include <iostream>

#include "base/exit_error.h"
#include "cli/report_file.h"
#include "cli/values.h"
#include "services/common/bus.h"
#include "services/common/clock.h"
#include "services/common/common_options.h"
#include "services/common/health.h"
#include "services/common/health_monitor.h"
#include "services/spy/bus_survey.h"
#include "services/spy/listen.h"
#include "services/spy/service_wait.h"
#include "services/spy/status.h"

namespace prospect::services {
namespace {

void DefineSeconds(CLI::App& app, double& seconds, double most) {
  app.add_option("--seconds", seconds, "how long to listen at most")
      ->type_name("S")
      ->check(cli::Real(0.1, most))
      ->capture_default_str();
}

}  // namespace

void Define(CLI::App& app, CheckOptions& options) {
  DefineSeconds(app, options.seconds, 86400);
  cli::DefineReport(app, options.report);
  cli::DefineProcess(app, options.bus);
}

void Define(CLI::App& app, WaitOptions& options) {
  app.add_option("--services", options.services, "such as simulator=1,model=1,worker=2")
      ->type_name("LIST")
      ->required();
  DefineSeconds(app, options.seconds, 86400);
  cli::DefineProcess(app, options.bus);
}

void Define(CLI::App& app, HeardOptions& options) {
  DefineSeconds(app, options.seconds, 60);
  cli::DefineProcess(app, options.bus);
}

void Define(CLI::App& app, HealthOptions& options) {
  app.add_option("--instance-file", options.instance_file,
                 "as the service was given, for health checks")
      ->type_name("FILE")
      ->envname("PROSPECT_INSTANCE_FILE")
      ->required();
  DefineSeconds(app, options.seconds, 60);
  cli::DefineProcess(app, options.bus);
}

void Define(CLI::App& app, ProbeOptions& options) { cli::DefineProcess(app, options.bus); }

int RunCheck(const CheckOptions& options) {
  ApplyCommonOptions(CommonOptions(options.bus), "bus");
  Bus bus(options.bus.bus);
  BusSurvey survey;
  const auto subscription =
      bus.SubscribeAll([&](const RawMessage& message) { survey.Add(message); });
  const double seconds = Listen(bus, options.seconds);
  if (options.report.talks()) survey.Print(seconds, std::cout);
  cli::WriteReport(options.report, survey.ToJson(seconds));
  return kExitSuccess;
}

int RunWait(const WaitOptions& options) {
  ApplyCommonOptions(CommonOptions(options.bus), "bus");
  const ServiceCounts wanted = ParseServices(options.services);
  Bus bus(options.bus.bus);
  HealthMonitor monitor(bus);
  WaitForServices(bus, monitor, wanted, options.seconds);
  return kExitSuccess;
}

int RunHeard(const HeardOptions& options) {
  ApplyCommonOptions(CommonOptions(options.bus), "bus");
  Bus bus(options.bus.bus);
  const HealthMonitor monitor(bus);
  RequireSomebody(bus, monitor, options.seconds);
  return kExitSuccess;
}

// Whether the service that wrote the file is at work, by what it says on the bus.
int RunHealth(const HealthOptions& options) {
  ApplyCommonOptions(CommonOptions(options.bus), "health");
  const std::int64_t instance_id = ReadInstanceFile(options.instance_file);
  Bus bus(options.bus.bus);
  const HealthMonitor monitor(bus);
  const health_t health = WaitForInstance(bus, monitor, instance_id, options.seconds);
  std::printf("%s: %s\n", health.service.c_str(), StateName(health.state));
  return kExitSuccess;
}

// A message to itself, by the way that all messages take; then listens for other deployments.
int RunProbe(const ProbeOptions& options) {
  ApplyCommonOptions(CommonOptions(options.bus), "probe");
  Bus bus(options.bus.bus);
  HealthMonitor monitor(bus);
  HealthBeacon beacon(bus, "probe");
  const std::int64_t start_ms = SteadyMs();
  while (monitor.Find(beacon.instance_id()) == nullptr) {
    if (SteadyMs() - start_ms > 3000) {
      throw ExitError(kExitBus,
                      "a message sent on " + bus.url() +
                          " did not come back: a firewall, or an interface without multicast");
    }
    beacon.Tick();
    bus.Poll(50);
  }
  const std::int64_t round_ms = SteadyMs() - start_ms;
  monitor.RequireOwnBus();
  std::printf("a message came back after %lld ms; %zu processes of a deployment are there\n",
              static_cast<long long>(round_ms), monitor.Alive().size() - 1);
  beacon.SetState(health_t::STATE_DRAINING);
  beacon.PublishNow();
  return kExitSuccess;
}

}  // namespace prospect::services

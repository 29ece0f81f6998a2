// prospect-bus: looks at the bus from a terminal.
//   prospect-bus check --seconds S [--json FILE]   lists channels, types, rates and what could not
//   be decoded
//   prospect-bus wait --services LIST              returns when they are there and ready
//   prospect-bus heard                             returns when anybody of a deployment is heard
//   prospect-bus health --instance-file FILE       is that very service at work (for health checks)
//   prospect-bus status [--watch] [--json FILE]    every process: its state, age, queue, restarts
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "base/json_file.h"
#include "base/run_main.h"
#include "services/common/bus.h"
#include "services/common/clock.h"
#include "services/common/common_options.h"
#include "services/common/health.h"
#include "services/common/health_monitor.h"
#include "services/common/host_filter.h"
#include "services/common/signals.h"
#include "services/spy/bus_survey.h"
#include "services/spy/service_wait.h"
#include "services/spy/status.h"

namespace prospect::services {
namespace {

struct CheckOptions {
  CommonOptions common;
  double seconds = 5;
  std::string json;
};

struct WaitOptions {
  CommonOptions common;
  std::string services;
  double seconds = 20;
};

struct HealthOptions {
  CommonOptions common;
  std::string instance_file;
  double seconds = 3;  // three signs of life
};

struct HeardOptions {
  CommonOptions common;
  double seconds = 3;  // three signs of life
};

struct StatusOptions {
  CommonOptions common;
  std::string services_file;
  std::string json;
  double seconds = 1.2;  // a little more than the time between two signs of life
  bool watch = false;
};

// Listens until the time is over or a signal comes. Returns the seconds listened.
double Listen(Bus& bus, double seconds) {
  const std::int64_t start_ms = SteadyMs();
  const auto length_ms = static_cast<std::int64_t>(1000 * seconds);
  std::int64_t passed_ms = 0;
  while (passed_ms < length_ms && !StopRequested()) {
    bus.Poll(static_cast<int>(length_ms - passed_ms));
    passed_ms = SteadyMs() - start_ms;
  }
  return static_cast<double>(std::max<std::int64_t>(passed_ms, 1)) / 1000;
}

int Check(const CheckOptions& options) {
  ApplyCommonOptions(options.common, "bus");
  Bus bus(options.common.bus);
  BusSurvey survey;
  const auto subscription =
      bus.SubscribeAll([&](const RawMessage& message) { survey.Add(message); });
  const double seconds = Listen(bus, options.seconds);
  survey.Print(seconds, std::cout);
  if (!options.json.empty()) base::WriteJsonFile(options.json, survey.ToJson(seconds));
  return kExitSuccess;
}

int Wait(const WaitOptions& options) {
  ApplyCommonOptions(options.common, "bus");
  const ServiceCounts wanted = ParseServices(options.services);
  Bus bus(options.common.bus);
  HealthMonitor monitor(bus);
  WaitForServices(bus, monitor, wanted, options.seconds);
  return kExitSuccess;
}

int Heard(const HeardOptions& options) {
  ApplyCommonOptions(options.common, "bus");
  Bus bus(options.common.bus);
  const HealthMonitor monitor(bus);
  RequireSomebody(bus, monitor, options.seconds);
  return kExitSuccess;
}

// Whether the service that wrote the file is at work, by what it says on the bus.
int Health(const HealthOptions& options) {
  ApplyCommonOptions(options.common, "health");
  const std::int64_t instance_id = ReadInstanceFile(options.instance_file);
  Bus bus(options.common.bus);
  const HealthMonitor monitor(bus);
  const health_t health = WaitForInstance(bus, monitor, instance_id, options.seconds);
  std::printf("%s: %s\n", health.service.c_str(), StateName(health.state));
  return kExitSuccess;
}

// What the supervisor on this machine wrote; null without one.
nlohmann::json ReadServices(const std::string& path) {
  std::ifstream in(path);
  if (!in) return nullptr;
  nlohmann::json services = nlohmann::json::parse(in, nullptr, false);
  return services.is_discarded() ? nlohmann::json() : services;
}

// Who can be heard here, and who is believed.
void PrintReach(const Bus& bus, std::ostream& out) {
  out << "Bus " << bus.url() << ": hears " << ReachText(bus.url()) << ", "
      << (bus.keyed() ? "believes whoever has the key"
                      : "open: whoever can send on it can move the robot")
      << "\n";
  if (bus.refused() > 0)
    out << bus.refused() << " messages were refused: "
        << (bus.keyed() ? "not from whoever has this key" : "do they need a key (--key)?") << "\n";
}

int Status(const StatusOptions& options) {
  ApplyCommonOptions(options.common, "status");
  Bus bus(options.common.bus);
  HealthMonitor monitor(bus);
  std::vector<StatusRow> rows;
  do {
    Listen(bus, options.seconds);
    rows = StatusRows(monitor.Alive(), ReadServices(options.services_file), SteadyMs());
    if (options.watch) std::cout << "\033[H\033[2J";  // the table takes the screen's place
    if (!rows.empty() || bus.refused() > 0) PrintReach(bus, std::cout);
    PrintStatus(rows, std::cout);
    std::cout.flush();
  } while (options.watch && !StopRequested());
  if (!options.json.empty()) {
    nlohmann::json report = StatusJson(rows);
    report["bus"] = bus.url();
    report["reach"] = ReachText(bus.url());
    report["keyed"] = bus.keyed();
    report["refused"] = bus.refused();
    base::WriteJsonFile(options.json, report);
  }
  return AllWell(rows) || options.watch ? kExitSuccess : kExitServiceLost;
}

CLI::App* AddHealth(CLI::App& app, HealthOptions& options) {
  CLI::App* health =
      app.add_subcommand("health", "is the service that wrote this instance file at work");
  AddCommonOptions(*health, options.common);
  health
      ->add_option("--instance-file", options.instance_file,
                   "as the service was given, for health checks")
      ->envname("PROSPECT_INSTANCE_FILE")
      ->required();
  health->add_option("--seconds", options.seconds, "how long to listen at most")
      ->check(CLI::Range(0.1, 60.0))
      ->capture_default_str();
  return health;
}

CLI::App* AddHeard(CLI::App& app, HeardOptions& options) {
  CLI::App* heard = app.add_subcommand("heard", "is anybody of a deployment there");
  AddCommonOptions(*heard, options.common);
  heard->add_option("--seconds", options.seconds, "how long to listen at most")
      ->check(CLI::Range(0.1, 60.0))
      ->capture_default_str();
  return heard;
}

CLI::App* AddStatus(CLI::App& app, StatusOptions& options) {
  CLI::App* status = app.add_subcommand("status", "every process: state, age, queue, restarts");
  AddCommonOptions(*status, options.common);
  status->add_option("--services-file", options.services_file, "a supervisor's services.json");
  status->add_option("--seconds", options.seconds, "how long to listen")
      ->check(CLI::Range(0.1, 60.0))
      ->capture_default_str();
  status->add_flag("--watch", options.watch, "again and again, until Ctrl-C");
  status->add_option("--json", options.json, "also write the table to this file");
  return status;
}

// A message to itself, by the way that all messages take; then listens for other deployments.
int Probe(const CommonOptions& options) {
  ApplyCommonOptions(options, "probe");
  Bus bus(options.bus);
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

CLI::App* AddCheck(CLI::App& app, CheckOptions& options) {
  CLI::App* check =
      app.add_subcommand("check", "list channels, types, rates and what could not be decoded");
  AddCommonOptions(*check, options.common);
  check->add_option("--seconds", options.seconds, "how long to listen")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str();
  check->add_option("--json", options.json, "also write the table to this file");
  return check;
}

void AddWait(CLI::App& app, WaitOptions& options) {
  CLI::App* wait = app.add_subcommand("wait", "return when services are there and ready");
  AddCommonOptions(*wait, options.common);
  wait->add_option("--services", options.services, "such as simulator=1,model=1,worker=2")
      ->required();
  wait->add_option("--seconds", options.seconds, "how long to wait at most")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str();
}

int Run(int argc, char** argv) {
  CLI::App app("Looks at the bus.");
  app.require_subcommand(1);
  CheckOptions check_options;
  WaitOptions wait_options;
  StatusOptions status_options;
  HealthOptions health_options;
  const CLI::App* check = AddCheck(app, check_options);
  const CLI::App* status = AddStatus(app, status_options);
  HeardOptions heard_options;
  const CLI::App* health = AddHealth(app, health_options);
  const CLI::App* heard = AddHeard(app, heard_options);
  AddWait(app, wait_options);
  CommonOptions probe_options;
  const CLI::App* probe =
      app.add_subcommand("probe", "does a message come back, and is the bus free");
  AddCommonOptions(*app.get_subcommand("probe"), probe_options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  if (probe->parsed()) return Probe(probe_options);
  if (status->parsed()) return Status(status_options);
  if (health->parsed()) return Health(health_options);
  if (heard->parsed()) return Heard(heard_options);
  return check->parsed() ? Check(check_options) : Wait(wait_options);
}

}  // namespace
}  // namespace prospect::services

int main(int argc, char** argv) {
  return prospect::RunMain([&] { return prospect::services::Run(argc, argv); });
}

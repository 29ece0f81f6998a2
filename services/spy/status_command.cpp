#include <fstream>
#include <iostream>

#include "cli/report_file.h"
#include "services/common/bus.h"
#include "services/common/clock.h"
#include "services/common/common_options.h"
#include "services/common/health_monitor.h"
#include "services/common/host_filter.h"
#include "services/common/signals.h"
#include "services/spy/commands.h"
#include "services/spy/listen.h"
#include "services/spy/status.h"

namespace prospect::services {
namespace {

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

// With `again` the table takes the screen's place.
void PrintTable(const Bus& bus, const std::vector<StatusRow>& rows, bool again) {
  if (again) std::cout << "\033[H\033[2J";
  if (!rows.empty() || bus.refused() > 0) PrintReach(bus, std::cout);
  PrintStatus(rows, std::cout);
  std::cout.flush();
}

nlohmann::json ReportOf(const Bus& bus, const std::vector<StatusRow>& rows) {
  nlohmann::json report = StatusJson(rows);
  report["bus"] = bus.url();
  report["reach"] = ReachText(bus.url());
  report["keyed"] = bus.keyed();
  report["refused"] = bus.refused();
  return report;
}

}  // namespace

int RunStatus(const cli::StatusOptions& options) {
  ApplyCommonOptions(CommonOptions(options.bus), "status");
  Bus bus(options.bus.bus);
  HealthMonitor monitor(bus);
  std::vector<StatusRow> rows;
  do {
    Listen(bus, options.seconds);
    rows = StatusRows(monitor.Alive(), ReadServices(options.services_file), SteadyMs());
    if (options.report.talks()) PrintTable(bus, rows, options.watch);
  } while (options.watch && !StopRequested());
  cli::WriteReport(options.report, ReportOf(bus, rows));
  return AllWell(rows) || options.watch ? kExitSuccess : kExitServiceLost;
}

}  // namespace prospect::services

#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "services/common/health_monitor.h"

namespace prospect::services {

/// One process of a deployment as `prospect status` shows it: what it says on HEALTH, and what its
/// supervisor knows of it, if there is one on this machine.
struct StatusRow {
  std::string name;  ///< "worker-2"; the service's kind where no supervisor named it
  std::string host;
  int pid = -1;
  std::string state;  ///< "ready", "busy", ..., "silent", "waiting", "given up"
  double age_s = -1;  ///< since its last sign of life; -1: none was heard
  int queue = 0;      ///< items
  double cpu_s = 0;   ///< processor time since its start
  double memory_mb = 0;
  std::int64_t received = 0;  ///< messages
  std::int64_t refused = 0;   ///< messages
  int restarts = -1;          ///< -1: nobody counts
  std::string note;
  bool well = false;  ///< there and at work
};

/// "ready", "busy", ...: a STATE_ of health_t in words.
const char* StateName(std::int8_t state);

/// Joins what was heard with `services_file`, a supervisor's services.json (null: no supervisor).
/// Supervised services come first in their order, then whoever else is on the bus.
std::vector<StatusRow> StatusRows(const std::vector<HealthMonitor::Peer>& peers,
                                  const nlohmann::json& services_file, std::int64_t now_ms);

void PrintStatus(const std::vector<StatusRow>& rows, std::ostream& out);

/// Key rows: a list of objects with the fields of StatusRow.
nlohmann::json StatusJson(const std::vector<StatusRow>& rows);

/// Whether there is something and all of it is well.
bool AllWell(const std::vector<StatusRow>& rows);

}  // namespace prospect::services

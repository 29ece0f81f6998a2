#include "services/spy/status.h"
#include "cli/installation.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace prospect::services {
namespace {

using nlohmann::json;

std::string HostName() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

void FillFromHealth(const HealthMonitor::Peer& peer, std::int64_t now_ms, StatusRow* row) {
  const health_t& health = peer.health;
  row->host = health.host;
  row->pid = health.pid;
  row->state = StateName(health.state);
  row->age_s = static_cast<double>(now_ms - peer.heard_ms) / 1000;
  row->queue = health.queue;
  row->cpu_s = health.cpu_seconds;
  row->memory_mb = static_cast<double>(health.rss_kb) / 1024;
  row->received = health.received;
  row->refused = health.refused;
  row->note = health.message;
  row->well = health.state == health_t::STATE_READY || health.state == health_t::STATE_BUSY;
}

std::string HowItEnded(int status, const std::string& last_words) {
  if (status > 128) return "killed by signal " + std::to_string(status - 128);
  return "ended with " + std::to_string(status) + ": " + last_words;
}

StatusRow Supervised(const json& service) {
  StatusRow row;
  row.name = service.at("name");
  row.pid = service.at("pid");
  row.restarts = service.at("restarts");
  row.state = service.at("state");
  if (row.state == "given_up") row.state = "given up";
  if (row.state == "running") row.state = "silent";  // until it is heard
  if (!service.at("last_exit").is_null()) {
    row.note = HowItEnded(service.at("last_exit"), service.at("last_words"));
  }
  return row;
}

}  // namespace

const char* StateName(std::int8_t state) {
  switch (state) {
    case health_t::STATE_STARTING:
      return "starting";
    case health_t::STATE_READY:
      return "ready";
    case health_t::STATE_BUSY:
      return "busy";
    case health_t::STATE_DRAINING:
      return "stopping";
    case health_t::STATE_FAULT:
      return "fault";
    default:
      return "unknown";
  }
}

std::vector<StatusRow> StatusRows(const std::vector<HealthMonitor::Peer>& peers,
                                  const json& services_file, std::int64_t now_ms) {
  std::vector<StatusRow> rows;
  std::vector<bool> shown(peers.size());
  const std::string here = HostName();
  const json supervised =
      services_file.is_null() ? json::array() : services_file.value("services", json::array());
  for (const json& service : supervised) {
    StatusRow row = Supervised(service);
    for (std::size_t i = 0; i < peers.size(); ++i) {
      if (peers[i].health.pid != row.pid || peers[i].health.host != here) continue;
      shown[i] = true;
      const std::string before = row.note;
      FillFromHealth(peers[i], now_ms, &row);
      if (row.note.empty() && !before.empty()) row.note = "before: " + before;
    }
    rows.push_back(row);
  }
  for (std::size_t i = 0; i < peers.size(); ++i) {
    if (shown[i]) continue;
    StatusRow row;
    row.name = peers[i].health.service;
    FillFromHealth(peers[i], now_ms, &row);
    rows.push_back(row);
  }
  return rows;
}

void PrintStatus(const std::vector<StatusRow>& rows, std::ostream& out) {
  if (rows.empty()) {
    out << "Nothing is on this bus: " << cli::Typed("up") << " starts a deployment.\n";
    return;
  }
  char line[400];
  std::snprintf(line, sizeof line, "%-12s %-12s %7s  %-9s %6s %6s %8s %8s %9s %8s %8s  %s\n",
                "Service", "Host", "Pid", "State", "Age s", "Queue", "CPU s", "MB", "Received",
                "Refused", "Restarts", "Note");
  out << line;
  for (const StatusRow& row : rows) {
    char age[16] = "-", pid[16] = "-", restarts[16] = "-";
    if (row.age_s >= 0) std::snprintf(age, sizeof age, "%.1f", row.age_s);
    if (row.pid >= 0) std::snprintf(pid, sizeof pid, "%d", row.pid);
    if (row.restarts >= 0) std::snprintf(restarts, sizeof restarts, "%d", row.restarts);
    std::snprintf(line, sizeof line,
                  "%-12s %-12s %7s  %-9s %6s %6d %8.1f %8.1f %9lld %8lld %8s  %.160s\n",
                  row.name.c_str(), row.host.c_str(), pid, row.state.c_str(), age, row.queue,
                  row.cpu_s, row.memory_mb, static_cast<long long>(row.received),
                  static_cast<long long>(row.refused), restarts, row.note.c_str());
    out << line;
  }
}

json StatusJson(const std::vector<StatusRow>& rows) {
  json list = json::array();
  for (const StatusRow& row : rows) {
    list.push_back({{"name", row.name},
                    {"host", row.host},
                    {"pid", row.pid},
                    {"state", row.state},
                    {"age_s", row.age_s},
                    {"queue", row.queue},
                    {"cpu_s", row.cpu_s},
                    {"memory_mb", row.memory_mb},
                    {"received", row.received},
                    {"refused", row.refused},
                    {"restarts", row.restarts},
                    {"note", row.note},
                    {"well", row.well}});
  }
  return {{"rows", list}};
}

bool AllWell(const std::vector<StatusRow>& rows) {
  return !rows.empty() &&
         std::all_of(rows.begin(), rows.end(), [](const StatusRow& row) { return row.well; });
}

}  // namespace prospect::services

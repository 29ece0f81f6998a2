#include "services/spy/service_wait.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "cli/installation.h"
#include "services/common/clock.h"
#include "services/common/signals.h"
#include "services/spy/status.h"

namespace prospect::services {
namespace {

[[noreturn]] void RefuseServices(const std::string& text) {
  throw ExitError(
      kExitUsage,
      "'" + text + "' is no list of services: write it like simulator=1,model=1,worker=2");
}

int ParseCount(const std::string& digits, const std::string& text) {
  const bool number = !digits.empty() && digits.size() <= 4 &&
                      digits.find_first_not_of("0123456789") == std::string::npos;
  if (!number) RefuseServices(text);
  return std::stoi(digits);
}

// A robot need not send HEALTH.
bool HasHeardARobot(const Bus& bus) {
  const auto task = bus.counters().find(ChannelOf<task_t>());
  return task != bus.counters().end() && task->second.received > 0;
}

bool IsAtWork(const HealthMonitor::Peer& peer) {
  return peer.health.state == health_t::STATE_READY || peer.health.state == health_t::STATE_BUSY;
}

}  // namespace

ServiceCounts ParseServices(const std::string& text) {
  ServiceCounts wanted;
  std::istringstream items(text);
  for (std::string item; std::getline(items, item, ',');) {
    const std::string name = item.substr(0, item.find('='));
    if (name.empty()) RefuseServices(text);
    wanted[name] += name == item ? 1 : ParseCount(item.substr(name.size() + 1), text);
  }
  if (wanted.empty()) RefuseServices(text);
  return wanted;
}

ServiceCounts MissingServices(const ServiceCounts& wanted, const HealthMonitor& monitor) {
  ServiceCounts missing;
  for (const auto& [service, count] : wanted) {
    const auto alive = monitor.Alive(service);
    const auto there = std::count_if(alive.begin(), alive.end(), IsAtWork);
    if (there < count) missing[service] = count - static_cast<int>(there);
  }
  return missing;
}

std::string DescribeMissing(const ServiceCounts& missing, const HealthMonitor& monitor) {
  std::string text;
  for (const auto& [service, count] : missing) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + service;
  }
  for (const HealthMonitor::Peer& peer : monitor.Alive()) {
    if (peer.health.state == health_t::STATE_FAULT)
      text += "; " + peer.health.service + " says: " + peer.health.message;
  }
  return text;
}

void WaitForServices(Bus& bus, HealthMonitor& monitor, const ServiceCounts& wanted,
                     double seconds) {
  constexpr std::int64_t kTurnMs = 100;  // so that a death by silence is seen while nothing arrives
  const std::int64_t end_ms = SteadyMs() + static_cast<std::int64_t>(1000 * seconds);
  ServiceCounts missing = MissingServices(wanted, monitor);
  while (!missing.empty()) {
    const std::int64_t left_ms = end_ms - SteadyMs();
    if (StopRequested()) throw ExitError(kExitInterrupted, "interrupted");
    if (left_ms <= 0) {
      throw ExitError(kExitTimeout, "still missing on " + bus.url() + ": " +
                                        DescribeMissing(missing, monitor) +
                                        "; see the services' logs");
    }
    bus.Poll(static_cast<int>(std::min(left_ms, kTurnMs)));
    monitor.RequireOwnBus(0);
    missing = MissingServices(wanted, monitor);
  }
}

void RequireSomebody(Bus& bus, const HealthMonitor& monitor, double seconds) {
  constexpr std::int64_t kSilentMs = 1000;
  const std::int64_t start_ms = SteadyMs();
  const std::int64_t end_ms = start_ms + static_cast<std::int64_t>(1000 * seconds);
  bool told = false;
  const auto subscription =
      bus.Subscribe<task_t>([](const task_t&) {});  // so that they are counted
  while (!HasHeardARobot(bus) && monitor.Alive().empty()) {
    const std::int64_t now_ms = SteadyMs();
    if (StopRequested()) throw ExitError(kExitInterrupted, "interrupted");
    if (now_ms >= end_ms) {
      const char* refused = bus.refused() > 0 ? " (what is heard is refused: --key FILE?)" : "";
      throw ExitError(kExitServiceLost,
                      "nothing is up on " + bus.url() + refused + ": " + cli::Typed("up"));
    }
    if (!told && now_ms >= start_ms + kSilentMs) {
      told = true;
      std::fprintf(stderr, "waiting for somebody on %s\n", bus.url().c_str());
    }
    bus.Poll(static_cast<int>(std::min<std::int64_t>(end_ms - now_ms, 100)));
  }
}

health_t WaitForInstance(Bus& bus, const HealthMonitor& monitor, std::int64_t instance_id,
                         double seconds) {
  const std::int64_t end_ms = SteadyMs() + static_cast<std::int64_t>(1000 * seconds);
  while (true) {
    const HealthMonitor::Peer* peer = monitor.Find(instance_id);
    if (peer && IsAtWork(*peer)) return peer->health;
    const std::int64_t left_ms = end_ms - SteadyMs();
    if (StopRequested()) throw ExitError(kExitInterrupted, "interrupted");
    if (left_ms > 0) {
      bus.Poll(static_cast<int>(left_ms));
      continue;
    }
    if (!peer) throw ExitError(kExitServiceLost, "the service is not heard on " + bus.url());
    const std::string note = peer->health.message.empty() ? "" : ": " + peer->health.message;
    throw ExitError(kExitServiceLost, peer->health.service + " is not at work: state " +
                                          StateName(peer->health.state) + note);
  }
}

}  // namespace prospect::services

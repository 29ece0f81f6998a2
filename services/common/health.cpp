#include "services/common/health.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

#include "base/atomic_file.h"
#include "base/exit_error.h"
#include "services/common/ids.h"

namespace prospect::services {
namespace {

std::string HostName() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "";
}

double CpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::int64_t ResidentKb() {
  std::ifstream file("/proc/self/statm");
  std::int64_t total = 0;
  std::int64_t resident = 0;
  return file >> total >> resident ? resident * sysconf(_SC_PAGESIZE) / 1024 : 0;
}

std::string& InstanceFile() {
  static std::string path;
  return path;
}

// Whole: a health check may read at any moment.
void WriteInstanceFile(std::int64_t id) {
  if (!InstanceFile().empty()) base::WriteFile(InstanceFile(), std::to_string(id) + "\n");
}

}  // namespace

void SetInstanceFile(const std::string& path) { InstanceFile() = path; }

std::int64_t ReadInstanceFile(const std::string& path) {
  std::ifstream file(path);
  std::int64_t id = 0;
  if (file >> id) return id;
  throw ExitError(kExitDataFile,
                  path +
                      " holds no instance id: the service has not come so far, or was started "
                      "without --instance-file");
}

HealthBeacon::HealthBeacon(Bus& bus, std::string service) : bus_(bus) {
  message_.service = std::move(service);
  message_.instance_id = RandomId();
  message_.deployment_id = DeploymentId();
  message_.pid = static_cast<std::int32_t>(getpid());
  message_.host = HostName();
  message_.state = health_t::STATE_STARTING;
  WriteInstanceFile(message_.instance_id);
}

void HealthBeacon::SetState(std::int8_t state, const std::string& note) {
  if (state == message_.state && note == message_.message) return;
  message_.state = state;
  message_.message = note;
  beat_.Hurry();
}

void HealthBeacon::Tick() {
  if (beat_.Due(SteadyMs())) PublishNow();
}

void HealthBeacon::PublishNow() {
  message_.utime = UtimeNow();
  message_.received = bus_.received();
  message_.refused = bus_.refused();
  message_.rss_kb = ResidentKb();
  message_.cpu_seconds = CpuSeconds();
  FillCounters();
  bus_.Publish(message_);
}

void HealthBeacon::FillCounters() {
  message_.counters.clear();
  for (const auto& [name, value] : counters_) message_.counters.push_back({name, value});
  for (const auto& [channel, counters] : bus_.counters()) {
    for (const auto& [reason, count] : counters.refused) {
      message_.counters.push_back({channel + ": " + reason, count});
    }
  }
  for (const auto& [name, count] : bus_.chaos_counters()) {
    message_.counters.push_back({"chaos: " + name, count});
  }
  messages::SetCounts(message_);
}

}  // namespace prospect::services

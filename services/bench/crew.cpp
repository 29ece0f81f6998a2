#include "services/bench/crew.h"

#include <filesystem>

namespace prospect::services {
namespace {

constexpr std::int64_t kStartMs = 20000;

double Sum(std::list<Child>& children) {
  double sum = 0;
  for (Child& child : children) sum += child.CpuSeconds();
  return sum;
}

}  // namespace

std::string Crew::LogName(const char* service) {
  std::filesystem::create_directories(logs_);
  return logs_ + "/" + service + "-" + std::to_string(++started_) + ".log";
}

void Crew::StartServers(int count, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"--bus", talk_.bus().url()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  for (int i = 0; i < count; ++i)
    servers_.emplace_back("prospect-model-server", words, LogName("model"));
  Await("model", count);
}

void Crew::HaveWorkers(int count) {
  while (workers() < count) {
    const std::vector<std::string> words{"--bus", talk_.bus().url(), "--index",
                                         std::to_string(workers())};
    workers_.emplace_back("prospect-worker", words, LogName("worker"));
  }
  Await("worker", count);
}

void Crew::Await(const char* service, int count) {
  const auto ready = [&] {
    return static_cast<int>(talk_.monitor().Alive(service).size()) >= count;
  };
  if (talk_.Until(ready, kStartMs)) return;
  throw ExitError(kExitServiceLost, std::string("a ") + service + " did not start: see " + logs_);
}

double Crew::ServerCpu() { return Sum(servers_); }
double Crew::WorkerCpu() { return Sum(workers_); }

}  // namespace prospect::services

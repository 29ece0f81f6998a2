#include "services/bench/crew.h"

#include <filesystem>

namespace prospect::services {
namespace {

constexpr std::int64_t kStartMs = 20000;

double Sum(std::vector<base::ChildProcess>& children) {
  double sum = 0;
  for (base::ChildProcess& child : children) sum += child.CpuSeconds();
  return sum;
}

}  // namespace

base::ChildProcess Crew::Start(const std::string& program, const std::string& service,
                               const std::vector<std::string>& arguments) {
  base::ChildOptions options;
  options.command = {base::ProgramBeside(program), "--bus", talk_.bus().url()};
  if (!std::filesystem::exists(options.command[0])) {
    throw ExitError(kExitServiceLost, "no " + options.command[0] + ": it is not built");
  }
  options.command.insert(options.command.end(), arguments.begin(), arguments.end());
  std::filesystem::create_directories(logs_);
  const base::Descriptor log =
      base::OpenOutput(logs_ + "/" + service + "-" + std::to_string(++started_) + ".log");
  options.out = options.err = log.get();
  return base::ChildProcess(options);
}

void Crew::StartServers(int count, const std::vector<std::string>& arguments) {
  for (int i = 0; i < count; ++i)
    servers_.push_back(Start("prospect-model-server", "model", arguments));
  Await("model", count);
}

void Crew::HaveWorkers(int count) {
  while (workers() < count) {
    workers_.push_back(Start("prospect-worker", "worker", {"--index", std::to_string(workers())}));
  }
  Await("worker", count);
}

void Crew::Await(const std::string& service, int count) {
  const auto ready = [&] {
    return static_cast<int>(talk_.monitor().Alive(service).size()) >= count;
  };
  if (talk_.Until(ready, kStartMs)) return;
  throw ExitError(kExitServiceLost, "a " + service + " did not start: see " + logs_);
}

double Crew::ServerCpu() { return Sum(servers_); }
double Crew::WorkerCpu() { return Sum(workers_); }

}  // namespace prospect::services

#include "services/supervisor/supervisor.h"

#include <signal.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>
#include <utility>

#include "base/json_file.h"
#include "services/common/clock.h"
#include "services/common/ids.h"
#include "services/common/run_main.h"
#include "services/supervisor/child.h"

namespace prospect::services {
namespace {

using nlohmann::json;

bool IsWorker(const ServiceSpec& spec) { return spec.name.rfind("worker-", 0) == 0; }

// The last line of a log: what the service said before it ended.
std::string LastLine(const std::string& path) {
  std::ifstream in(path);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

}  // namespace

Supervisor::Supervisor(DeploymentSpec deployment, int workers, std::string state, std::string logs)
    : deployment_(std::move(deployment)), state_(std::move(state)), logs_(std::move(logs)) {
  services_.emplace_back(ModelSpec(deployment_));
  if (deployment_.simulator) services_.emplace_back(SimulatorSpec(deployment_));
  Scale(workers);
  WriteState();
  Turn();
}

Supervisor::~Supervisor() { Stop(0); }

std::string Supervisor::LogOf(const Service& service) const {
  return logs_ + "/" + service.spec.name + ".log";
}

void Supervisor::Turn() {
  for (EndedChild ended = ReapChild(); ended.pid >= 0; ended = ReapChild()) {
    NoteEnd(ended.pid, ended.status);
  }
  const std::int64_t now_ms = SteadyMs();
  for (Service& service : services_) {
    if (service.state == State::kWaiting && now_ms >= service.due_ms) Start(&service);
  }
  if (std::exchange(changed_, false)) KeepState();
}

// A deployment that runs goes on when its disk is full.
void Supervisor::KeepState() const {
  try {
    WriteState();
  } catch (const base::DiskError& error) {
    spdlog::error("{}; the services go on", error.what());
  }
}

void Supervisor::Start(Service* service) {
  service->pid = StartChild(service->spec.command, LogOf(*service));
  service->state = State::kRunning;
  service->started_ms = SteadyMs();
  ++service->restarts;
  changed_ = true;
  spdlog::info("{} {}, pid {}", service->spec.name,
               service->restarts == 0 ? "started" : "started again", service->pid);
}

void Supervisor::NoteEnd(int pid, int status) {
  const auto found = std::find_if(services_.begin(), services_.end(),
                                  [pid](const Service& s) { return s.pid == pid; });
  if (found == services_.end()) return;
  changed_ = true;
  if (found->leaving) {
    services_.erase(found);
    return;
  }
  found->pid = -1;
  found->last_exit = status;
  found->last_words = LastLine(LogOf(*found));
  const auto pause_ms = found->policy.AfterEnd(status, SteadyMs() - found->started_ms);
  found->state = pause_ms ? State::kWaiting : State::kGivenUp;
  found->due_ms = SteadyMs() + pause_ms.value_or(0);
  spdlog::warn("{} ended with {}: {}; {}", found->spec.name, status, found->last_words,
               pause_ms ? "starts again in " + std::to_string(*pause_ms) + " ms"
                        : "another start would not help");
}

int Supervisor::CountWorkers() const {
  return static_cast<int>(std::count_if(services_.begin(), services_.end(), [](const Service& s) {
    return IsWorker(s.spec) && !s.leaving;
  }));
}

void Supervisor::Scale(int workers) {
  workers = std::clamp(workers, 0, 1024);
  for (int have = CountWorkers(); have < workers; ++have) {
    services_.emplace_back(WorkerSpec(deployment_, next_worker_++));
  }
  // The newest go first; a worker hands its rows over when it is asked to stop.
  for (auto service = services_.end(); service != services_.begin() && CountWorkers() > workers;) {
    --service;
    if (!IsWorker(service->spec) || service->leaving) continue;
    service->leaving = true;
    if (service->pid >= 0) {
      kill(service->pid, SIGTERM);
    } else {
      service = services_.erase(service);
    }
  }
  changed_ = true;
}

void Supervisor::Stop(std::int64_t patience_ms) {
  const auto running = [this] {
    for (EndedChild ended = ReapChild(); ended.pid >= 0; ended = ReapChild()) {
      for (Service& service : services_) {
        if (service.pid == ended.pid) service.pid = -1;
      }
    }
    return std::any_of(services_.begin(), services_.end(),
                       [](const Service& s) { return s.pid >= 0; });
  };
  const auto send = [this](int signal) {
    for (const Service& service : services_) {
      if (service.pid >= 0) kill(service.pid, signal);
    }
  };
  if (!running()) return;
  send(SIGTERM);
  const std::int64_t end_ms = SteadyMs() + patience_ms;
  while (running() && SteadyMs() < end_ms) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  send(SIGKILL);
  while (running()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

json Supervisor::Describe(const Service& service) const {
  const char* names[] = {"running", "waiting", "given_up"};
  return {{"name", service.spec.name},
          {"pid", service.pid},
          {"state", service.leaving ? "leaving" : names[static_cast<int>(service.state)]},
          {"restarts", std::max(0, service.restarts)},
          {"last_exit", service.last_exit < 0 ? json(nullptr) : json(service.last_exit)},
          {"last_words", service.last_words}};
}

void Supervisor::WriteState() const {
  // The same for shells, before services.json, so that who reads that finds both: name, status,
  // last words.
  std::ostringstream given_up;
  for (const Service& service : services_) {
    if (service.state != State::kGivenUp) continue;
    given_up << service.spec.name << '\t' << service.last_exit << '\t' << service.last_words
             << '\n';
  }
  base::WriteFile(state_ + "/given_up", given_up.str());
  json services = json::array();
  for (const Service& service : services_) services.push_back(Describe(service));
  base::WriteJsonFile(state_ + "/services.json", {{"deployment", DeploymentId()},
                                                  {"bus", deployment_.bus},
                                                  {"task", deployment_.task},
                                                  {"supervisor_pid", getpid()},
                                                  {"logs", logs_},
                                                  {"services", services}});
}

}  // namespace prospect::services

#include "services/supervisor/supervisor.h"

#include <signal.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

#include "base/exit_error.h"
#include "base/json_file.h"
#include "services/common/clock.h"
#include "services/common/ids.h"

namespace prospect::services {
namespace {

using nlohmann::json;

bool IsWorker(const ServiceSpec& spec) { return spec.name.starts_with("worker-"); }

// Logs of workers that an earlier, larger deployment had would tell of this one.
// Whether a file of this name is the log of a worker, "worker-3.log" or "worker-3.1.log": the
// folder may hold other people's.
bool IsWorkerLog(const std::string& name) {
  constexpr char kBegin[] = "worker-";
  if (!name.starts_with(kBegin)) return false;
  const std::size_t end = name.find_first_not_of("0123456789", sizeof kBegin - 1);
  if (end == std::string::npos || end == sizeof kBegin - 1) return false;
  return name.substr(end) == ".log" || name.substr(end) == ".1.log";
}

void RemoveOldLogs(const std::string& folder) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (IsWorkerLog(name) &&
        entry.symlink_status(ignored).type() == std::filesystem::file_type::regular) {
      std::filesystem::remove(entry.path(), ignored);
    }
  }
}

const char* WorldOf(const DeploymentSpec& deployment) {
  if (!deployment.simulator) return "robot";
  return deployment.player ? "video" : "simulator";
}

}  // namespace

Supervisor::Supervisor(DeploymentSpec deployment, int workers, std::string state, std::string logs)
    : deployment_(std::move(deployment)), state_(std::move(state)), logs_(std::move(logs)) {
  RemoveOldLogs(logs_);
  Add(ModelSpec(deployment_));
  if (deployment_.simulator) Add(SimulatorSpec(deployment_));
  if (deployment_.console) Add(ConsoleSpec(deployment_, state_));
  Scale(workers);
  WriteState();
  Turn();
}

Supervisor::~Supervisor() { Stop(0); }

void Supervisor::Add(ServiceSpec spec) {
  const std::string log = logs_ + "/" + spec.name + ".log";
  services_.emplace_back(std::move(spec), log);
}

std::vector<int> Supervisor::Outputs() const {
  std::vector<int> outputs;
  for (const Service& service : services_) outputs.push_back(service.log.output());
  return outputs;
}

void Supervisor::DrainLogs() {
  for (Service& service : services_) service.log.Drain();
}

void Supervisor::Turn() {
  DrainLogs();
  NoteEnds();
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
  } catch (const std::exception& error) {
    spdlog::error("{}; the services go on", error.what());
  }
}

void Supervisor::Start(Service* service) {
  service->started_ms = SteadyMs();
  ++service->restarts;
  changed_ = true;
  base::ChildOptions options;
  options.command = service->spec.command;
  options.out = options.err = service->log.input();
  options.detached = true;         // Ctrl-C on the terminal is the supervisor's alone
  options.death_signal = SIGTERM;  // then a robot is told to stop, and files are closed
  try {
    service->child.emplace(options);
  } catch (const std::exception& error) {
    DecideAfterEnd(service, 1, error.what());
    return;
  }
  service->state = State::kRunning;
  spdlog::info("{} {}, pid {}", service->spec.name,
               service->restarts == 0 ? "started" : "started again", service->pid());
}

void Supervisor::NoteEnds() {
  for (Service& service : services_) {
    const std::optional<int> status = service.TakeEnd();
    if (!status) continue;
    changed_ = true;
    if (service.leaving) continue;
    service.log.Drain();
    DecideAfterEnd(&service, *status, service.log.LastLine());
  }
  services_.remove_if([](const Service& s) { return s.leaving && !s.runs(); });
}

void Supervisor::DecideAfterEnd(Service* service, int status, std::string last_words) {
  service->last_exit = status;
  service->last_words = std::move(last_words);
  const auto pause_ms = service->policy.AfterEnd(status, SteadyMs() - service->started_ms);
  service->state = pause_ms ? State::kWaiting : State::kGivenUp;
  service->due_ms = SteadyMs() + pause_ms.value_or(0);
  spdlog::warn("{} ended with {}: {}; {}", service->spec.name, status, service->last_words,
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
    Add(WorkerSpec(deployment_, next_worker_++));
  }
  // The newest go first; a worker hands its rows over when it is asked to stop.
  for (auto service = services_.end(); service != services_.begin() && CountWorkers() > workers;) {
    --service;
    if (!IsWorker(service->spec) || service->leaving) continue;
    service->leaving = true;
    if (service->runs()) {
      service->child->Signal(SIGTERM);
    } else {
      service = services_.erase(service);
    }
  }
  changed_ = true;
}

void Supervisor::Stop(std::int64_t patience_ms) {
  const auto running = [this] {
    DrainLogs();  // who waits for its last words to be taken does not end
    for (Service& service : services_) service.TakeEnd();
    return std::any_of(services_.begin(), services_.end(),
                       [](const Service& s) { return s.runs(); });
  };
  const auto send = [this](int signal) {
    for (Service& service : services_) {
      if (service.runs()) service.child->Signal(signal);
    }
  };
  if (!running()) return;
  send(SIGTERM);
  const std::int64_t end_ms = SteadyMs() + patience_ms;
  while (running() && SteadyMs() < end_ms) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  send(SIGKILL);
  // What the kernel does not let go (a dead network disk) is not waited for.
  const std::int64_t killed_ms = SteadyMs();
  while (running() && SteadyMs() < killed_ms + 2000) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

json Supervisor::Describe(const Service& service) const {
  const char* names[] = {"running", "waiting", "given_up"};
  return {{"name", service.spec.name},
          {"pid", service.pid()},
          {"state", service.leaving ? "leaving" : names[static_cast<int>(service.state)]},
          {"restarts", std::max(0, service.restarts)},
          {"last_exit", service.last_exit < 0 ? json(nullptr) : json(service.last_exit)},
          {"last_words", service.last_words}};
}

void Supervisor::WriteState() const {
  json services = json::array();
  for (const Service& service : services_) services.push_back(Describe(service));
  base::WriteJsonFile(state_ + "/services.json", {{"deployment", DeploymentId()},
                                                  {"bus", deployment_.bus},
                                                  {"task", deployment_.task},
                                                  {"task_file", deployment_.task_file},
                                                  {"weights", deployment_.weights},
                                                  {"world", WorldOf(deployment_)},
                                                  {"key", deployment_.key},
                                                  {"workers", CountWorkers()},
                                                  {"supervisor_pid", getpid()},
                                                  {"logs", logs_},
                                                  {"services", services}});
}

}  // namespace prospect::services

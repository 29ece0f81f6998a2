#pragma once

#include <cstdint>
#include <list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "services/supervisor/deployment.h"
#include "services/supervisor/restart_policy.h"

namespace prospect::services {

/// Keeps the processes of a deployment running: starts them, starts them again when they end
/// (RestartPolicy), stops them all. One log a service, appended to. What it knows stands in
/// STATE/services.json, rewritten at every change:
///   deployment, bus, task, supervisor_pid, services: a list of {name, pid, state ("running",
///   "waiting", "given_up", "leaving"), restarts, last_exit (null: never ended), last_words}
/// and STATE/given_up has a line for each given up, its name, status and last words between tabs.
///
/// One thread, which must call Turn() often: at least ten times a second.
class Supervisor {
 public:
  /// Starts model server, simulator and `workers` workers. `state` and `logs` are folders that
  /// exist. @throws std::runtime_error when a process or log cannot be made
  Supervisor(DeploymentSpec deployment, int workers, std::string state, std::string logs);

  /// Stops what still runs, hard.
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Takes note of what has ended and starts what is due.
  void Turn();

  /// Starts or stops workers until there are so many. 0 to 1024.
  void Scale(int workers);

  /// Stops everything: SIGTERM, and SIGKILL for what is still there after `patience_ms`.
  void Stop(std::int64_t patience_ms = 5000);

 private:
  enum class State { kRunning, kWaiting, kGivenUp };
  struct Service {
    explicit Service(ServiceSpec s) : spec(std::move(s)) {}
    ServiceSpec spec;
    RestartPolicy policy;
    State state = State::kWaiting;
    int pid = -1;
    int restarts = -1;  // the first start is none
    int last_exit = -1;
    std::int64_t started_ms = 0;
    std::int64_t due_ms = 0;
    std::string last_words;
    bool leaving = false;  // asked to stop by Scale()
  };

  void Start(Service* service);
  void NoteEnd(int pid, int status);
  int CountWorkers() const;
  std::string LogOf(const Service& service) const;
  nlohmann::json Describe(const Service& service) const;
  void WriteState() const;
  void KeepState() const;

  DeploymentSpec deployment_;
  std::string state_, logs_;
  std::list<Service> services_;
  bool changed_ = true;
  int next_worker_ = 1;
};

}  // namespace prospect::services

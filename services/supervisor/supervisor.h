#pragma once

#include <cstdint>
#include <list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/child_process.h"
#include "services/supervisor/deployment.h"
#include "services/supervisor/restart_policy.h"
#include "services/supervisor/service_log.h"

namespace prospect::services {

/// Keeps the processes of a deployment running: starts them, starts them again when they end
/// (RestartPolicy), stops them all. One log a service (ServiceLog). What it knows stands in
/// STATE/services.json, rewritten at every change:
///   deployment, bus, task, weights, world ("simulator", "robot", "video"), key (file; empty: an
///   open bus), workers, supervisor_pid, logs, services: a list of {name, pid, state ("running",
///   "waiting", "given_up", "leaving"), restarts, last_exit (null: never ended), last_words}
///
/// Once it is up, nothing that a service does, prints or names, and nothing that becomes of its
/// files, ends it. One thread, which must call Turn() often: at least ten times a second, and when
/// one of Outputs() can be read.
class Supervisor {
 public:
  /// Starts model server, simulator and `workers` workers. `state` is a folder that exists.
  /// @throws ExitError (kExitDisk) when its files cannot be written there
  Supervisor(DeploymentSpec deployment, int workers, std::string state, std::string logs);

  /// Stops what still runs, hard.
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Writes logs, takes note of what has ended and starts what is due.
  void Turn();

  /// What to poll: each can be read when its service has printed something.
  std::vector<int> Outputs() const;

  /// Starts or stops workers until there are so many. 0 to 1024.
  void Scale(int workers);

  /// Stops everything: SIGTERM, and SIGKILL for what is still there after `patience_ms`.
  void Stop(std::int64_t patience_ms = 5000);

 private:
  enum class State { kRunning, kWaiting, kGivenUp };
  struct Service {
    Service(ServiceSpec s, const std::string& log_file) : spec(std::move(s)), log(log_file) {}

    bool runs() const { return child.has_value(); }
    int pid() const { return child ? child->pid() : -1; }
    /// The exit status of a child that has ended; once.
    std::optional<int> TakeEnd() {
      const std::optional<int> status = child ? child->Status() : std::nullopt;
      if (status) child.reset();
      return status;
    }

    ServiceSpec spec;
    ServiceLog log;
    RestartPolicy policy;
    State state = State::kWaiting;
    std::optional<base::ChildProcess> child;
    int restarts = -1;  // the first start is none
    int last_exit = -1;
    std::int64_t started_ms = 0;
    std::int64_t due_ms = 0;
    std::string last_words;
    bool leaving = false;  // asked to stop by Scale()
  };

  void Add(ServiceSpec spec);
  void Start(Service* service);
  void NoteEnds();
  void DecideAfterEnd(Service* service, int status, std::string last_words);
  void DrainLogs();
  int CountWorkers() const;
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

#pragma once

#include <optional>
#include <string>

#include "cli/run/invocation.h"

namespace prospect::cli {

/// What a deployment says of itself that is up.
struct UpFacts {
  std::string key;        ///< file; empty: an open bus
  std::string task;       ///< its name
  std::string task_file;  ///< whole path; empty: an installed one
  std::string logs;       ///< folder
  int workers = 0;

  /// As --task takes it.
  const std::string& task_wish() const { return task_file.empty() ? task : task_file; }
};

/// The processes that one `up` started on one bus. prospect-supervisor starts them, keeps them and
/// knows, by a lock in the deployment's state folder, whether it lives; this asks it.
class Deployment {
 public:
  /// @param state its state folder; empty: that of the bus
  explicit Deployment(std::string bus, std::string state = "")
      : bus_(std::move(bus)), state_(std::move(state)) {}

  const std::string& bus() const { return bus_; }
  const std::string& state() const { return state_; }

  /// The state folder. @throws ExitError when it cannot be trusted
  std::string Folder() const;

  /// What is started from here on belongs to the deployment that is up, and has its key: the
  /// environment says so. @param wishes what it must be, as `prospect-supervisor join` takes it
  /// @return nothing when none is up @throws ExitError when it is not as wished for or not to be
  /// trusted
  std::optional<UpFacts> Join(const Words& wishes = {}) const;

  /// The same, where one must be up. @throws ExitError (kExitServiceLost)
  UpFacts Require() const;

  /// Starts one. @param arguments of prospect-supervisor; "--" and the simulator's come last
  /// @throws ExitError with its exit status; it has said why
  void Start(const Words& arguments) const;

  /// What Start() starts, for Become().
  Words StartCommand(const Words& arguments) const;

  /// Stops every process, politely first. @return the supervisor's exit status
  int Stop(bool silently) const;

  /// So many workers. @return the supervisor's exit status
  int Scale(int workers) const;

  /// Names the services that were given up, with their last words. @return the first one's exit
  /// status; 0: none was
  int TellGivenUp() const;

  /// Waits until services are ready. @param services as prospect-bus wait takes them
  /// @return 0, or its exit status; it has said why
  int Await(const std::string& services) const;

 private:
  Words Asking(const std::string& command, const Words& arguments = {}) const;

  std::string bus_, state_;
};

/// A new state folder that nobody else needs to find. @throws ExitError
std::string MakePrivateState();

}  // namespace prospect::cli

#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/child_process.h"

namespace prospect::services::console {

/// Programs that the page's buttons start: `prospect run` and `prospect scale`. One at a time each.
/// One thread, which must outlive them: they end with it.
class EpisodeStarter {
 public:
  /// @param bus URL @param out folder in which each run's results get a folder
  EpisodeStarter(std::string bus, std::string out) : bus_(std::move(bus)), out_(std::move(out)) {}

  /// Starts an episode. @param request {seed, goal, samples, threshold, retries, reset}
  /// @param task its name @return what is wrong with the request; empty: it runs
  std::string Run(const nlohmann::json& request, const std::string& task);
  /// Stops the episode as Ctrl-C does: the action is cancelled before anything else. A second call
  /// does nothing: a second signal would end the executive before the robot stands still.
  void Stop();
  /// Process id of `prospect run`; -1: none runs.
  int pid() const { return run_ ? run_->child.pid() : -1; }
  std::string Scale(int workers);

  bool running() { return run_ && run_->child.Running(); }
  bool scaling() { return scale_ && scale_->child.Running(); }
  /// {running, seed, out, exit, words} of the latest run; null: there was none. `words` is the last
  /// line that it printed.
  nlohmann::json Facts();

 private:
  struct Job {
    base::ChildProcess child;
    base::Descriptor said;
    std::optional<int> exit;
    std::string words;
    bool asked_to_stop = false;
  };

  static Job Start(const std::vector<std::string>& command);
  static void Look(Job* job);

  std::string bus_, out_;
  std::optional<Job> run_, scale_;
  std::int64_t seed_ = 0;
  std::string folder_;
};

/// The arguments of `prospect run` for a request. @throws std::exception when a field is missing or
/// out of range
std::vector<std::string> RunArguments(const nlohmann::json& request);

}  // namespace prospect::services::console

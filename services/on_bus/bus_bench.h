#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "agent/record.h"
#include "cli/commands/evaluate.h"

namespace prospect::services {

/// Episodes of several deciders, one after another, with whatever is on a bus: a simulator, a robot
/// that puts scenes up, or one whose table a person tidies. One thread.
class BusBench {
 public:
  /// The rows there are: "planner", "random" (a random plan that the table allows) and "greedy".
  static const std::vector<std::string>& Rows();

  /// Joins the bus and waits for all that the rows need. Throws ExitError.
  explicit BusBench(const cli::EvaluateOnBusOptions& options);
  ~BusBench();

  /// One episode of `row`, one of Rows(). Of scene `seed`, unless the options say that nobody puts
  /// scenes up; then the scene is what stands there. Throws ExitError as BusEpisode does, and
  /// kExitInterrupted after a stop signal: the robot is let go of.
  agent::EpisodeRecord Run(const std::string& row, std::int64_t seed);

  const std::string& task() const;     ///< as TASK names it
  const std::string& weights() const;  ///< hash of the model servers' weights, 16 digits

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace prospect::services

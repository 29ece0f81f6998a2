#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "sim/oracle.h"
#include "tools/evaluate/closed_loop.h"
#include "tools/evaluate/report.h"

namespace prospect::tools {

// Everything one process needs to evaluate scenes in closed loop. Not thread-safe.
class SceneBench {
 public:
  // Throws std::invalid_argument or model::WeightsError for what cannot be run.
  explicit SceneBench(const ClosedLoop& loop);
  ~SceneBench();

  // What the oracle says of a scene, and how each row fares in it.
  SceneRecord Run(std::uint64_t seed);

  // What the oracle says of a scene; for drawing scenes.
  sim::SceneClass ClassOf(std::uint64_t seed);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// N of a row "NAME=N"; nothing: another row. Throws std::invalid_argument where N is none.
std::optional<int> NumberOf(const std::string& row, const std::string& name);

}  // namespace prospect::tools

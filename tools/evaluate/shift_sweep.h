#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "agent/record.h"
#include "model/engine.h"
#include "model/novelty.h"
#include "planner/search_parameters.h"
#include "sim/shift.h"
#include "sim/task.h"
#include "sim/task_factory.h"

namespace prospect::tools {

// One setting of what pictures look like: no shift (strength 0), or a factor at a strength.
struct ShiftPoint {
  std::string factor;  // empty without a shift
  int strength = 0;

  std::string Name() const;  // "none", "light 3"
};

// No shift, then each of `factors` at every strength.
std::vector<ShiftPoint> ShiftPoints(const std::vector<std::string>& factors);

struct SweepOptions {
  std::string task;
  std::string weights;
  sim::TaskOptions world;
  planner::SearchParameters search;  // with the refusal threshold
  double novelty_level = model::kNoveltyLevel;
  std::vector<ShiftPoint> points;
};

// What a planner does in open loop with pictures it was not trained on: it looks once, under each
// shift, and either refuses or its plan is carried out as it is. A shift changes no physics and the
// execution noise depends on scene and actions alone, so each plan is carried out once a scene.
// Not thread safe.
class ShiftSweep {
 public:
  // Throws model::WeightsError or std::invalid_argument for what cannot be run.
  explicit ShiftSweep(const SweepOptions& options);

  // {seed, points: {NAME: {ending, reason, plan, score, p}}}; ending as ToString(Ending); p: the
  // novelty gauge's p-value, null where the weights hold no gauge; refused by it: "unlike" is true.
  nlohmann::json Run(std::uint64_t scene_seed);

 private:
  struct End {
    std::string ending, reason;
  };
  nlohmann::json RunPoint(std::uint64_t scene_seed, std::size_t point);
  agent::EpisodeRecord LookAndPlan(std::uint64_t scene_seed, std::size_t point);
  const End& CarryOut(std::uint64_t scene_seed, const std::vector<int>& plan);

  SweepOptions options_;
  std::unique_ptr<model::Engine> engine_;
  std::optional<model::NoveltyGauge> gauge_;
  std::unique_ptr<sim::Task> world_;                 // without a shift: where plans are carried out
  std::vector<std::unique_ptr<sim::Task>> looking_;  // one a point: where pictures are taken
  std::map<std::vector<int>, End> ends_;             // of plans in this scene
};

// For each point {name, factor, strength, amount, scenes, solved, refused, failed, unlike (refused
// for the picture), failed_share (of those attempted) and its interval, met}: met is whether the
// failures stay at most a fifth where at least 30 were attempted, null where fewer were.
nlohmann::json SummariseShifts(const std::vector<nlohmann::json>& scenes,
                               const std::vector<ShiftPoint>& points);

// The summary for a person.
std::string ShiftTable(const nlohmann::json& summary);

}  // namespace prospect::tools

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/random.h"
#include "cli/report_file.h"
#include "sim/rollout.h"
#include "sim/stacking/action_table.h"
#include "sim/stacking/stacking_task.h"
#include "tools/bench/commands.h"
#include "tools/common/fork_map.h"
#include "tools/common/interval.h"
#include "tools/common/progress.h"

namespace prospect::tools {
namespace {

using nlohmann::json;

constexpr std::uint64_t kPairStream = 0x7069636b73ULL;

constexpr double kObstacleRadius = 0.025, kHalfBlock = 0.025;  // m, as in the default scene

// Metres between the obstacle's surface and the nearest of the two blocks' surfaces and the line
// between their centres, on the table.
double Clearance(const sim::StackingScene& scene, int pick, int place) {
  const auto flat = [](const Eigen::Isometry3d& pose) {
    return Eigen::Vector2d(pose.translation().head<2>());
  };
  const Eigen::Vector2d a = flat(scene.blocks[pick]), b = flat(scene.blocks[place]);
  const Eigen::Vector2d way = b - a, obstacle = flat(scene.obstacle);
  const double along = std::clamp((obstacle - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
  const double to_line = (a + along * way - obstacle).norm();
  const double to_block = std::min((a - obstacle).norm(), (b - obstacle).norm());
  return std::min(to_line, to_block - kHalfBlock) - kObstacleRadius;
}

struct Pair {
  std::uint64_t seed = 0;
  int pick = 0, place = 0;
};

// One of the scene's pairs that are clear of the obstacle, at random.
std::optional<Pair> ClearPair(const sim::StackingScene& scene, std::uint64_t seed,
                              double clearance) {
  std::vector<Pair> pairs;
  const int blocks = static_cast<int>(scene.blocks.size());
  for (int pick = 0; pick < blocks; ++pick) {
    for (int place = 0; place < blocks; ++place) {
      if (pick != place && Clearance(scene, pick, place) > clearance) {
        pairs.push_back({seed, pick, place});
      }
    }
  }
  if (pairs.empty()) return std::nullopt;
  base::Random random(base::MixSeeds({seed, kPairStream}));
  return pairs[random.Below(static_cast<int>(pairs.size()))];
}

std::vector<Pair> FindPairs(const cli::BenchPicksOptions& options) {
  sim::StackingTask task({});
  std::vector<Pair> pairs;
  for (std::uint64_t seed = options.seed; static_cast<int>(pairs.size()) < options.scenes; ++seed) {
    if (seed - options.seed > 1'000'000) {
      throw std::invalid_argument("no scene has so much room: lower --clearance");
    }
    task.Reset(seed);
    if (const auto pair = ClearPair(task.scene(), seed, options.clearance)) pairs.push_back(*pair);
  }
  return pairs;
}

std::vector<int> PlanOf(const Pair& pair, int blocks) {
  std::vector<int> plan;
  for (int kind = 0; kind < sim::kStackingKinds; ++kind) {
    const bool picks = kind < static_cast<int>(sim::StackingKind::kAlignOver);
    plan.push_back(sim::StackingIndex(static_cast<sim::StackingKind>(kind),
                                      picks ? pair.pick : pair.place, blocks));
  }
  return plan;
}

// Keys: noise, scenes, successes, share, low, high, failures (by reason).
json Row(double noise, const std::vector<Pair>& pairs, const cli::BenchPicksOptions& options) {
  std::map<std::string, int> failures;
  int successes = 0;
  const int scenes = static_cast<int>(pairs.size());
  Progress progress("picks", scenes);
  const auto make_work = [&] {
    sim::TaskOptions world;
    world.execution_noise = noise;
    auto task = std::make_shared<sim::StackingTask>(world);
    return [task, &pairs](int i) {
      task->Reset(pairs[i].seed);
      const int blocks = static_cast<int>(task->scene().blocks.size());
      return sim::RunPlan(*task, PlanOf(pairs[i], blocks), nullptr).reason;
    };
  };
  const Extent extent =
      ForkMap(scenes, options.jobs, make_work, [&](int, const std::string& reason) {
        reason.empty() ? ++successes : ++failures[reason];
        progress.Step();
      });
  if (extent.stopped()) throw Interrupted(extent.Words("picks"));
  const Share share = ShareOf(successes, scenes);
  return {{"noise", noise},       {"scenes", scenes}, {"successes", successes},
          {"share", share.value}, {"low", share.low}, {"high", share.high},
          {"failures", failures}};
}

void Print(const json& row) {
  std::printf("noise x %g: %d of %d (%.1f %%, %.1f to %.1f)", row["noise"].get<double>(),
              row["successes"].get<int>(), row["scenes"].get<int>(),
              100 * row["share"].get<double>(), 100 * row["low"].get<double>(),
              100 * row["high"].get<double>());
  for (const auto& [reason, count] : row["failures"].items()) {
    std::printf("; %s %d", reason.c_str(), count.get<int>());
  }
  std::printf("\n");
}

}  // namespace

int RunBenchPicks(const cli::BenchPicksOptions& options) {
  const std::vector<Pair> pairs = FindPairs(options);
  json rows = json::array();
  for (const double noise : options.noise) {
    rows.push_back(Row(noise, pairs, options));
    if (options.report.talks()) Print(rows.back());
  }
  cli::WriteReport(options.report, {{"clearance", options.clearance}, {"rows", rows}});
  return 0;
}

}  // namespace prospect::tools

#include "sim/stacking/scene.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "base/random.h"

namespace prospect::sim {
namespace {

constexpr std::uint64_t kSceneStream = 0x737461636bULL;
constexpr int kTries = 1000;

Eigen::Isometry3d Standing(const Eigen::Vector2d& spot, double height, double yaw,
                           const StackingParameters& p, base::Random* random) {
  const double x = spot.x() + random->Uniform(0, p.jitter);
  const double y = spot.y() + random->Uniform(0, p.jitter);
  return Eigen::Translation3d(x, y, height / 2) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
}

void PlaceThings(int blocks, double obstacle_height, const StackingParameters& p,
                 base::Random* random, StackingScene* scene) {
  scene->blocks.clear();
  std::vector<Eigen::Vector2d> spots = p.block_spots;
  for (int i = 0; i < blocks; ++i) {
    const int pick = random->Below(static_cast<int>(spots.size()));
    const double yaw = random->Uniform(-p.yaw_jitter, p.yaw_jitter);
    scene->blocks.push_back(Standing(spots[pick], p.block_height, yaw, p, random));
    spots.erase(spots.begin() + pick);
  }
  const int pick = random->Below(static_cast<int>(p.obstacle_spots.size()));
  scene->obstacle = Standing(p.obstacle_spots[pick], obstacle_height, 0, p, random);
}

// Whether the obstacle stands free of all blocks.
bool ObstacleIsFree(const StackingScene& scene, const StackingParameters& p) {
  return std::none_of(
      scene.blocks.begin(), scene.blocks.end(), [&](const Eigen::Isometry3d& block) {
        const Eigen::Vector3d apart = block.translation() - scene.obstacle.translation();
        return apart.head<2>().norm() < p.obstacle_gap;
      });
}

}  // namespace

StackingScene DrawStackingScene(std::uint64_t seed, int blocks, double obstacle_height,
                                const StackingParameters& p) {
  base::Random random(base::MixSeeds({seed, kSceneStream}));
  StackingScene scene;
  scene.light = 1 + random.Uniform(-p.light_range, p.light_range);
  for (int i = 0; i < 6; ++i) {
    scene.joints[i] = p.start_joints[i] + random.Uniform(-p.start_jitter, p.start_jitter);
  }
  for (int i = 0; i < kTries; ++i) {
    PlaceThings(blocks, obstacle_height, p, &random, &scene);
    if (ObstacleIsFree(scene, p)) return scene;
  }
  throw std::runtime_error("stacking: the spots leave no room for an obstacle " +
                           std::to_string(p.obstacle_gap) +
                           " m from every block: give other obstacle_spots or block_spots");
}

}  // namespace prospect::sim

#include "sim/navigation/scene.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "sim/husky.h"
#include "sim/navigation/catalogue.h"

namespace prospect::sim {
namespace {

constexpr int kTries = 200;  // placements of one thing before the whole site is drawn anew

const Footprint& FootprintOf(const PlacedObject& object) {
  return ObjectCatalogue()[object.kind].footprint;
}

Pose2 RandomPose(double range, base::Random* random) {
  Pose2 pose;
  pose.x = random->Uniform(-range, range);
  pose.y = random->Uniform(-range, range);
  pose.yaw = random->Uniform(-M_PI, M_PI);
  return pose;
}

bool Inside(const Footprint& footprint, const Pose2& pose, double range) {
  for (const Eigen::Vector2d& corner : footprint.Corners(pose)) {
    if (corner.cwiseAbs().maxCoeff() + footprint.radius > range) return false;
  }
  return true;
}

// The paper's four kinds and `count` - 4 random others.
std::vector<int> DrawKinds(int count, base::Random* random) {
  std::vector<int> kinds = {0, 1, 2, 3};
  std::vector<int> others = {4, 5, 6};
  while (static_cast<int>(kinds.size()) < count) {
    const int pick = random->Below(static_cast<int>(others.size()));
    kinds.push_back(others[pick]);
    others.erase(others.begin() + pick);
  }
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

bool PlaceObject(int kind, const NavigationParameters& p, base::Random* random,
                 NavigationScene* scene) {
  const Footprint& footprint = ObjectCatalogue()[kind].footprint;
  for (int i = 0; i < kTries; ++i) {
    const PlacedObject object{kind, RandomPose(p.object_range, random)};
    const bool clear =
        std::none_of(scene->objects.begin(), scene->objects.end(), [&](const PlacedObject& other) {
          return Distance(footprint, object.pose, FootprintOf(other), other.pose) < p.object_gap;
        });
    if (clear && Inside(footprint, object.pose, p.object_range)) {
      scene->objects.push_back(object);
      return true;
    }
  }
  return false;
}

bool PlaceRobot(const NavigationParameters& p, base::Random* random, NavigationScene* scene) {
  for (int i = 0; i < kTries; ++i) {
    scene->start = RandomPose(p.start_range, random);
    const bool clear =
        std::none_of(scene->objects.begin(), scene->objects.end(), [&](const PlacedObject& object) {
          return DistanceToHull(object, scene->start) < p.start_gap;
        });
    if (clear) return true;
  }
  return false;
}

bool FillSite(const std::vector<int>& kinds, const NavigationParameters& p, base::Random* random,
              NavigationScene* scene) {
  scene->objects.clear();
  for (int kind : kinds) {
    if (!PlaceObject(kind, p, random, scene)) return false;
  }
  return PlaceRobot(p, random, scene);
}

bool Same(const Pose2& a, const Pose2& b) { return a.x == b.x && a.y == b.y && a.yaw == b.yaw; }

}  // namespace

bool operator==(const NavigationScene& a, const NavigationScene& b) {
  const auto same = [](const PlacedObject& one, const PlacedObject& other) {
    return one.kind == other.kind && Same(one.pose, other.pose);
  };
  return a.light == b.light && Same(a.start, b.start) && a.objects.size() == b.objects.size() &&
         std::equal(a.objects.begin(), a.objects.end(), b.objects.begin(), same);
}

NavigationScene DrawScene(std::uint64_t seed, int objects, const NavigationParameters& parameters) {
  base::Random random(base::MixSeeds({seed, 0x7363656e65ULL}));
  NavigationScene scene;
  scene.light = 1.0 + random.Uniform(-parameters.light_range, parameters.light_range);
  const std::vector<int> kinds = DrawKinds(objects, &random);
  while (!FillSite(kinds, parameters, &random, &scene)) {
  }
  return scene;
}

double DistanceToHull(const PlacedObject& object, const Pose2& pose) {
  static const Footprint hull = Husky::Hull();
  return Distance(hull, pose, FootprintOf(object), object.pose);
}

}  // namespace prospect::sim

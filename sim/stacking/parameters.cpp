#include "sim/stacking/parameters.h"

#include <algorithm>
#include <cmath>

namespace prospect::sim {
namespace {

std::vector<double> NumberList(const YamlReader& yaml, const std::string& key) {
  if (!yaml.node()[key].IsSequence() || yaml.node()[key].size() == 0) {
    yaml.Fail(key, "must be a list of numbers");
  }
  return yaml.Numbers(key, yaml.node()[key].size());
}

std::vector<Eigen::Vector2d> Grid(const YamlReader& yaml) {
  yaml.Only({"x", "y"});
  std::vector<Eigen::Vector2d> spots;
  for (double x : NumberList(yaml, "x")) {
    for (double y : NumberList(yaml, "y")) spots.emplace_back(x, y);
  }
  return spots;
}

std::vector<Eigen::Vector2d> SpotList(const YamlReader& yaml, const std::string& key) {
  std::vector<Eigen::Vector2d> spots;
  try {
    for (const YAML::Node& spot : yaml.node()[key]) {
      spots.emplace_back(spot[0].as<double>(), spot[1].as<double>());
    }
  } catch (const YAML::Exception&) {
    spots.clear();
  }
  const bool finite = std::all_of(spots.begin(), spots.end(),
                                  [](const Eigen::Vector2d& spot) { return spot.allFinite(); });
  if (spots.empty() || !finite) yaml.Fail(key, "must be a list of [x, y]");
  return spots;
}

Eigen::Matrix3d ApproachFrom(const YamlReader& yaml) {
  const Eigen::Vector3d z = yaml.Vector("approach").normalized();
  const Eigen::Vector3d y = yaml.Vector("finger_axis").normalized();
  if (!(std::abs(z.dot(y)) < 1e-3)) yaml.Fail("finger_axis", "must be square to approach");
  Eigen::Matrix3d tool;
  tool << y.cross(z), y, z;
  return tool;
}

void ReadStart(const YamlReader& yaml, StackingParameters* p) {
  p->block_height = yaml.Number("block_height", 0.01, 0.2);
  p->block_spots = Grid(yaml.At("block_spots"));
  p->obstacle_spots = SpotList(yaml, "obstacle_spots");
  p->obstacle_gap = yaml.Number("obstacle_gap", 0, 1);
  p->jitter = yaml.Number("jitter", 0, 0.05);
  p->yaw_jitter = yaml.Number("yaw_jitter", 0, M_PI);
  const std::vector<double> joints = yaml.Numbers("start_joints", 6);
  std::copy(joints.begin(), joints.end(), p->start_joints.begin());
  p->start_jitter = yaml.Number("start_jitter", 0, 1);
  p->light_range = yaml.Number("light_range", 0, 0.5);
}

void ReadTimes(const YamlReader& yaml, StackingParameters* p) {
  p->tick = yaml.Number("tick", 0.01, 1);
  p->control = yaml.Number("control", 0.002, 0.1);
  p->time_limit = yaml.Number("time_limit", 1, 1000);
  p->most_actions = yaml.Integer("most_actions", 9, 1000);
  p->close_time = yaml.Number("close_time", 0, 10);
  p->open_time = yaml.Number("open_time", 0, 10);
}

void ReadMotion(const YamlReader& yaml, StackingParameters* p) {
  p->approach = ApproachFrom(yaml);
  p->align_offset = yaml.Vector("align_offset");
  p->grasp_offset = yaml.Vector("grasp_offset");
  p->over_offset = yaml.Vector("over_offset");
  p->stack_offset = yaml.Vector("stack_offset");
  p->home = yaml.Vector("home");
  p->tolerance = yaml.Number("tolerance", 1e-4, 0.1);
  p->home_tolerance = yaml.Number("home_tolerance", 1e-4, 0.5);
  p->turn_tolerance = yaml.Number("turn_tolerance", 1e-6, 1);
  p->still = yaml.Number("still", 1e-4, 10);
  p->speed = yaml.Number("speed", 0.01, 2);
  p->turn_speed = yaml.Number("turn_speed", 0.01, 10);
  p->acceleration = yaml.Number("acceleration", 0.01, 100);
}

void ReadNoise(const YamlReader& yaml, StackingParameters* p) {
  yaml.Only({"grip", "place", "speed", "release_delay", "early_release"});
  p->grip_noise = yaml.Number("grip", 0, 0.05);
  p->place_noise = yaml.Number("place", 0, 0.05);
  p->speed_noise = yaml.Number("speed", 0, 0.3);
  p->release_delay = yaml.Number("release_delay", 0, 2);
  p->early_release = yaml.Number("early_release", 0, 1);
}

void ReadBox(const YamlReader& yaml, Eigen::Vector3d* low, Eigen::Vector3d* high) {
  yaml.Only({"low", "high"});
  *low = yaml.Vector("low");
  *high = yaml.Vector("high");
  if (!((*high - *low).minCoeff() > 0)) yaml.Fail("high", "must be above low");
}

void CheckSteps(const YamlReader& yaml, double step, const StackingParameters& p) {
  const auto whole = [](double a, double b) {
    return a >= b && std::abs(a / b - std::round(a / b)) < 1e-6;
  };
  if (!whole(p.tick, p.control)) yaml.Fail("tick", "must be a multiple of control");
  if (!whole(p.control, step)) yaml.Fail("control", "must be a multiple of physics.step");
}

}  // namespace

StackingParameters ReadStackingParameters(const YamlReader& root, int blocks) {
  const YamlReader yaml = root.At("stacking");
  yaml.Only({"block_height",   "block_spots",    "obstacle_spots", "obstacle_gap", "jitter",
             "yaw_jitter",     "start_joints",   "start_jitter",   "light_range",  "tick",
             "control",        "time_limit",     "most_actions",   "approach",     "finger_axis",
             "align_offset",   "grasp_offset",   "over_offset",    "stack_offset", "home",
             "tolerance",      "home_tolerance", "turn_tolerance", "still",        "close_time",
             "open_time",      "speed",          "turn_speed",     "acceleration", "noise",
             "stacked_within", "workspace",      "table"});
  StackingParameters p;
  ReadStart(yaml, &p);
  ReadTimes(yaml, &p);
  ReadMotion(yaml, &p);
  ReadNoise(yaml.At("noise"), &p);
  p.stacked_within = yaml.Number("stacked_within", 1e-3, 1);
  ReadBox(yaml.At("workspace"), &p.workspace_low, &p.workspace_high);
  ReadBox(yaml.At("table"), &p.table_low, &p.table_high);
  CheckSteps(yaml, root.At("physics").Number("step", 1e-4, 0.01), p);
  if (static_cast<int>(p.block_spots.size()) < blocks) {
    yaml.Fail("block_spots", "must be at least as many as there are blocks");
  }
  return p;
}

}  // namespace prospect::sim

#pragma once

#include <memory>
#include <vector>

#include "sim/camera.h"
#include "sim/husky.h"
#include "sim/navigation/goto_controller.h"
#include "sim/navigation/parameters.h"
#include "sim/navigation/scene.h"
#include "sim/ode_world.h"
#include "sim/task.h"
#include "sim/task_factory.h"

namespace prospect::sim {

// The navigation task of the paper: a Husky on a construction site that must investigate several
// different objects in a row. A leg succeeds when the robot faces its object and its hull is within
// `reach` of the object's face in time, and then comes to rest. The trial fails when a leg runs out
// of time ("time"), when the robot touches any object
// ("collision(NAME)"), or when a corner of its hull leaves the site ("left_site").
class NavigationTask : public Task {
 public:
  // Throws std::invalid_argument if options.objects or options.legs is out of range.
  explicit NavigationTask(const TaskOptions& options);
  ~NavigationTask() override;

  const TaskSpec& spec() const override { return spec_; }
  void Reset(std::uint64_t seed) override;
  bool StartAction(int action) override;
  void Cancel() override;
  void Tick() override;
  Image Observe() override;
  Image Render(int width, int height) override;
  Progress progress() const override;
  std::vector<double> RobotState() const override;
  std::vector<Landmark> Landmarks() const override;
  std::unique_ptr<TaskState> Save() const override;
  void Restore(const TaskState& state) override;
  void SetNoiseSeed(std::uint64_t noise_seed) override;
  std::vector<int> LegalActions() const override;
  std::vector<bool> PresentActions() const override;
  // visited(X) of each object investigated.
  std::vector<std::string> Facts() const override;
  double light() const override { return scene_.light; }

  // Builds a given site instead of a drawn one; for tests. `noise_seed` feeds the execution noise.
  void ResetTo(const NavigationScene& scene, std::uint64_t noise_seed);

  const NavigationScene& scene() const { return scene_; }

  // Pixels of a width x height picture whose centre shows the robot.
  int CountRobotPixels(int width, int height);

 private:
  // What changes while a trial runs, besides the bodies.
  struct Trial {
    Progress progress;
    std::int64_t steps = 0;      // physics steps since the reset
    std::int64_t leg_start = 0;  // step on which the running leg began
    std::int64_t arrived = -1;   // step on which its end condition was met; -1 before
    std::uint64_t noise_seed = 0;
    std::uint64_t history = 0;  // hash of the actions started
    std::vector<bool> visited;  // per action
    GotoController controller;
  };
  struct State;

  void BuildSite();
  void DestroyObjects();
  void BuildCamera();
  void Step();
  Twist2 Command();
  void Judge();
  void JudgeLeg();
  void FinishLeg();
  void Fail(const std::string& reason);
  bool Settled() const;
  int TouchedObject() const;
  bool LeftSite() const;
  const PlacedObject* Find(int action) const;
  double TargetGap() const;
  bool running() const { return trial_.progress.action_state == ActionState::kRunning; }

  const NavigationParameters& parameters_;
  TaskOptions options_;
  TaskSpec spec_;
  NavigationScene scene_;
  Trial trial_;
  OdeWorld world_;
  Husky robot_;
  std::vector<dGeomID> object_geoms_;     // as scene_.objects
  std::unique_ptr<AerialCamera> camera_;  // made when first asked for: the oracle never looks
};

}  // namespace prospect::sim

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/scene_camera.h"
#include "sim/stacking/controller.h"
#include "sim/stacking/judge.h"
#include "sim/stacking/parameters.h"
#include "sim/stacking/scene.h"
#include "sim/tabletop/scene_description.h"
#include "sim/tabletop/tabletop_world.h"
#include "sim/task.h"
#include "sim/task_factory.h"

namespace prospect::sim {

// The paper's block-stacking task: a UR5 is to pick up any block and put it on any other, past an
// obstacle, in 30 s; touching the obstacle ends the trial (StackingOutcome has all causes). The
// action table is in action_table.h, the scene and all constants are in the scene file.
//
// With a tower of 3 or 4 the plan, the time and the number of actions grow in proportion. A plan is
// exhausted when its last action (home) ends without a tower, or after most_actions.
class StackingTask : public Task {
 public:
  // Throws std::invalid_argument for a tower out of range or a scene file that cannot be used.
  explicit StackingTask(const TaskOptions& options);

  const TaskSpec& spec() const override { return spec_; }
  void Reset(std::uint64_t seed) override;
  bool StartAction(int action) override;
  void Cancel() override;
  void Tick() override;
  Image Observe() override;
  Image Render(int width, int height) override;
  Progress progress() const override { return trial_.progress; }
  std::vector<double> RobotState() const override;
  std::unique_ptr<TaskState> Save() const override;
  void Restore(const TaskState& state) override;
  void SetNoiseSeed(std::uint64_t noise_seed) override { trial_.noise_seed = noise_seed; }
  std::vector<int> LegalActions() const override;
  std::vector<bool> PresentActions() const override;
  // on(X,Y) of each block that rests on another with no hand on either.
  std::vector<std::string> Facts() const override;
  double light() const override { return scene_.light; }
  std::vector<Landmark> Landmarks() const override;

  // The picture of one of the scene file's cameras. Throws std::invalid_argument for an unknown one
  // (the message lists them) or a size out of range.
  Image RenderFrom(const std::string& camera, int width, int height);
  std::vector<std::string> Cameras() const;

  // Depth and what each pixel shows, from the observed camera's place.
  DepthImage ObserveDepth(int width, int height);

  // Puts up a given scene instead of a drawn one; for tests.
  void ResetTo(const StackingScene& scene, std::uint64_t noise_seed);
  const StackingScene& scene() const { return scene_; }
  const TabletopWorld& world() const { return world_; }
  const StackingParameters& parameters() const { return parameters_; }
  StackingVerdict verdict() const { return trial_.verdict; }

 private:
  // What changes while a trial runs, besides the bodies.
  struct Trial {
    Progress progress;
    std::int64_t steps = 0;  // physics steps since the reset
    int last_done = 0;       // the last action that succeeded; null_action() before
    std::uint64_t noise_seed = 0;
    std::uint64_t history = 0;  // hash of the actions started
    StackingController controller;
    StackingVerdict verdict;
  };
  struct State;

  void Settle();
  bool ControlPeriod();
  void JudgeTick();
  void FinishAction();
  void End(const StackingVerdict& verdict);
  std::vector<Eigen::Isometry3d> VisualPoses() const;
  SceneCamera& camera();
  int blocks() const { return static_cast<int>(description_.blocks.size()); }
  bool running() const { return trial_.progress.action_state == ActionState::kRunning; }

  TaskOptions options_;
  TabletopDescription description_;
  StackingParameters parameters_;
  TaskSpec spec_;
  double obstacle_height_ = 0;
  double time_limit_ = 0;
  int most_actions_ = 0;
  TabletopWorld world_;
  StackingJudge judge_;
  StackingScene scene_;
  Trial trial_;
  std::unique_ptr<SceneCamera> camera_;  // made when first asked for: the oracle never looks
};

}  // namespace prospect::sim

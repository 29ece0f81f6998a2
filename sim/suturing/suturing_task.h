#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/suturing/endoscope.h"
#include "sim/suturing/gesture_player.h"
#include "sim/suturing/parameters.h"
#include "sim/suturing/scene.h"
#include "sim/suturing/suturing_world.h"
#include "sim/task.h"
#include "sim/task_factory.h"

namespace prospect::sim {

// A simulated stand-in for the paper's suturing videos (JIGSAWS): two instruments stitch a cut in a
// pad with a curved needle and a thread, four throws a trial, seen by an endoscope. The actions are
// surgical gestures (gestures.h). The trial succeeds when the last gesture (G11) ends with all
// throws made; it fails when that comes too early ("incomplete"), when a gesture goes wrong
// (gesture_player.h), or when time is up ("time"). No planning is claimed for this task.
class SuturingTask : public Task {
 public:
  // Throws std::invalid_argument for options out of range.
  explicit SuturingTask(const TaskOptions& options);

  const TaskSpec& spec() const override { return spec_; }
  void Reset(std::uint64_t seed) override;
  bool StartAction(int action) override;
  void Cancel() override;
  void Tick() override;
  Image Observe() override;
  Image Render(int width, int height) override;
  Progress progress() const override { return trial_.progress; }
  // Of each hand, the right one first: x, y, z (m), a unit quaternion w, x, y, z, the jaws' opening
  // (rad).
  std::vector<double> RobotState() const override;
  // The right hand, the left hand, the needle's tip and its tail.
  std::vector<Landmark> Landmarks() const override;
  std::unique_ptr<TaskState> Save() const override;
  void Restore(const TaskState& state) override;
  void SetNoiseSeed(std::uint64_t noise_seed) override { trial_.noise_seed = noise_seed; }
  std::vector<int> LegalActions() const override;
  std::vector<bool> PresentActions() const override;
  // "held(needle,right)", "held(needle,left)", "throws(N)".
  std::vector<std::string> Facts() const override;
  double light() const override { return scene_.light; }

  // What the other eye of a stereo endoscope sees.
  Image RenderRightEye(int width, int height);

  // Whether all stitches are made.
  bool AllThrown() const { return trial_.suture.throws() == p_.throws; }

  const SuturingScene& scene() const { return scene_; }
  const SuturingWorld& world() const { return world_; }
  const SuturingParameters& parameters() const { return p_; }
  const Suture& suture() const { return trial_.suture; }

 private:
  // What changes while a trial runs, besides the bodies.
  struct Trial {
    Progress progress;
    std::int64_t steps = 0;  // physics steps since the reset
    int last_done = 0;       // the last gesture that succeeded; null_action() before
    std::uint64_t noise_seed = 0;
    std::uint64_t history = 0;  // hash of the gestures started
    GesturePlayer player;
    Suture suture;
  };
  struct State;

  void StepOnce();
  void FinishGesture();
  void End(bool success, const std::string& reason);
  Image RenderFrom(double sideways, int width, int height);
  Endoscope& endoscope();
  bool running() const { return trial_.progress.action_state == ActionState::kRunning; }

  TaskOptions options_;
  SuturingParameters p_;
  TaskSpec spec_;
  int steps_per_tick_;
  SuturingWorld world_;
  SuturingScene scene_;
  Trial trial_;
  std::unique_ptr<Endoscope> endoscope_;  // made when first asked for
};

}  // namespace prospect::sim

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/image.h"

namespace prospect::sim {

// A task as everything outside sim/ sees it: a frozen table of high-level actions, a world that
// carries them out one at a time in simulated time, a camera, and a verdict. Worlds are stochastic
// by design (start, execution noise) and bit-repeatable: on one machine the same seeds and calls
// give the same states and images.
//
// Threads: a Task is used by one thread at a time; several Task objects may live in several
// threads. Ownership: a Task owns its physics and camera; what it returns is copied out.

// One row of the action table.
struct ActionSpec {
  int index = 0;       // position in the table: the number on the bus and in data sets
  std::string name;    // "investigate(barrel)"
  std::string kind;    // "investigate"
  std::string object;  // "barrel"
};

// One way in which trials of a task fail.
struct CauseSpec {
  std::string name;   // as Progress::reason gives it: "collision(barrel)"
  std::string words;  // for people: "it ran into the barrel"
};

// What is fixed about a task before any scene is drawn.
struct TaskSpec {
  std::string name;  // "navigation"
  std::string
      world_version;  // names the world's constants: another string means other physics or looks
  std::vector<ActionSpec> actions;
  int plan_length = 0;  // actions in a complete plan
  int image_width = 0;  // of Observe()
  int image_height = 0;
  double tick_seconds = 0.1;     // simulated seconds a Tick() advances; the camera's period
  double step_seconds = 0.001;   // simulated seconds of one physics step
  double action_time_limit = 0;  // simulated seconds an action may take before it fails
  // [actions.size() + 1]: which actions may follow each action by the task's graph; the last row is
  // for null_action(), that is the start of a trial. Ascending.
  std::vector<std::vector<int>> successors;
  bool repeats_allowed = false;  // whether an action may occur twice in a plan
  // Every reason that Progress can give.
  std::vector<CauseSpec> causes;
  // Names of the points that Landmarks() gives, in its order; may be none.
  std::vector<std::string> landmarks;

  // The label of "no action yet": one past the last action.
  int null_action() const { return static_cast<int>(actions.size()); }

  // Whether `next` after `action` (null_action(): at the start) goes back to try again.
  bool IsRetry(int action, int next) const;

  // FNV-1a over a canonical text of what two programs must agree on to talk about this task: name,
  // action table, successors, whether repeats are allowed, image size. Causes, landmarks, scene
  // parameters (plan_length) and the world's constants are left out, so that one set of weights
  // serves all of a task's scenes.
  std::uint64_t Hash() const;
};

enum class ActionState { kIdle, kRunning, kSucceeded, kFailed, kCancelled };

// Whether `next` after `action` goes back to the beginning although the plan could go on: it may
// come first, and `action` has successors that may not. `successors` as TaskSpec's. Whoever
// enumerates plans leaves such steps out.
bool IsRetry(const std::vector<std::vector<int>>& successors, int action, int next);

// The verdict on the whole trial.
enum class Outcome { kRunning, kSuccess, kFailure };

// A point of the scene in Observe()'s picture: u from the left edge (0) to the right (1), v from
// the upper edge (0) to the lower (1). Both NaN if what it belongs to is not part of the scene;
// outside [0, 1] if the camera does not see that far.
struct Landmark {
  double u = 0;
  double v = 0;
};

// Where a trial stands now.
struct Progress {
  double time = 0;  // simulated seconds since Reset
  int action = 0;   // the running action, or the last one that ran; null_action() before the first
  int previous_action = 0;  // the one before `action`; null_action() if there was none
  int segment = -1;         // number of actions started so far, less one; -1 before the first
  ActionState action_state = ActionState::kIdle;
  int actions_done = 0;  // actions that succeeded
  Outcome outcome = Outcome::kRunning;
  std::string reason;  // why the trial failed, a name in TaskSpec::causes: "time",
                       // "obstacle(gripper)"; else empty
};

const char* ToString(ActionState state);  // "idle", "running", "succeeded", "failed", "cancelled"
const char* ToString(Outcome outcome);    // "running", "success", "failure"

// Opaque state made by Task::Save. Immutable; may be restored any number of times, also into
// another Task of the same kind.
class TaskState {
 public:
  virtual ~TaskState() = default;
};

class Task {
 public:
  virtual ~Task() = default;

  virtual const TaskSpec& spec() const = 0;

  // Draws the scene, the light and the execution noise of trial `seed` and sets the clock to 0.
  virtual void Reset(std::uint64_t seed) = 0;

  // Begins an action at the current time. Returns false and changes nothing if `action` is not in
  // LegalActions(), another action is running, or the trial is over.
  virtual bool StartAction(int action) = 0;

  // Gives the running action up: its state becomes kCancelled and the robot brakes during the ticks
  // that follow. The action does not count as done and stays legal. No effect if no action runs.
  virtual void Cancel() = 0;

  // Advances the world by spec().tick_seconds. The robot holds still (after braking) when no action
  // runs. Once the trial is over only the clock goes on.
  virtual void Tick() = 0;

  // The camera's picture of now, spec().image_width x spec().image_height, without sensor noise.
  virtual Image Observe() = 0;

  // The same view at another size, for people. width, height in 1..4096, else
  // std::invalid_argument.
  virtual Image Render(int width, int height) = 0;

  virtual Progress progress() const = 0;

  // The robot's state. Navigation: x, y (m, site frame), yaw (rad, in (-pi, pi]), v (m/s, forward),
  // w (rad/s). Stacking: six joints (rad), the gripper's opening (m), x, y, z of the tool (m).
  virtual std::vector<double> RobotState() const = 0;

  // Where robot and objects are in the picture, in the order of spec().landmarks. Only for training
  // networks and for tests: planning never sees it.
  virtual std::vector<Landmark> Landmarks() const { return {}; }

  // Everything that decides the future, exactly: after Restore the same calls give the same bits.
  virtual std::unique_ptr<TaskState> Save() const = 0;

  // Throws std::invalid_argument if `state` was made by another kind of task or with other options.
  virtual void Restore(const TaskState& state) = 0;

  // From the next StartAction on, execution noise is a function of (noise_seed, the actions started
  // since Reset) and of nothing else. So two plans with a common beginning see the same run of it
  // under one noise seed.
  virtual void SetNoiseSeed(std::uint64_t noise_seed) = 0;

  // What the task's own rules and the scene allow next (navigation: the object is there and was not
  // visited yet). Ascending; empty once the trial is over. Does not say whether an action would
  // succeed.
  virtual std::vector<int> LegalActions() const = 0;

  // Per action: whether its object is part of this scene.
  virtual std::vector<bool> PresentActions() const = 0;

  // What the world itself says holds now, of what people may want of it: "visited(barrel)",
  // "on(red,blue)". For verdicts and tests; planning never sees it.
  virtual std::vector<std::string> Facts() const { return {}; }

  // The scale of this trial's light, 0.9 to 1.1.
  virtual double light() const = 0;
};

}  // namespace prospect::sim

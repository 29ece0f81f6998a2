#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "agent/picture.h"
#include "agent/task_view.h"

namespace prospect::agent {

/// What the camera showed at one moment.
struct Glimpse {
  Picture picture;
  std::int64_t frame = 0;  ///< counts pictures of the episode: the same number, the same picture
  double seconds = 0;      ///< since the scene was set up, by the world's clock
};

/// How an action ended.
enum class ActionState {
  kSucceeded,
  kFailed,
  kCancelled,
  kRefused,  ///< it was not begun
};
const char* ToString(ActionState state);  ///< "succeeded", "failed", "cancelled", "refused"

/// How the whole trial stands, by whoever judges it.
enum class TrialOutcome {
  kUnknown,  ///< nobody judges it, as on most robots
  kRunning,
  kSuccess,
  kFailure,
};

/// What became of an action.
struct ActionResult {
  ActionState state = ActionState::kSucceeded;
  TrialOutcome outcome = TrialOutcome::kRunning;
  /// Failed: a name in TaskView::causes, or the robot's own word. Refused: why, for people.
  std::string reason;
};

/// Where an episode happens: a port that each host fills in, over a bus or in the same process. An
/// episode calls Await, Begin, then CarryOut and Look by turns, from one thread.
///
/// Whatever ends an episode from outside leaves these functions as a std::exception: whoever
/// carries actions out is lost or never was there, an action never ends, somebody asks to stop. The
/// robot must then stand still, or come to stand without another call.
class World {
 public:
  virtual ~World() = default;

  /// Waits for whoever carries actions out, and makes sure that nobody else commands it.
  virtual void Await() = 0;

  /// The task as it stands; after Await(). Begin() may change it.
  virtual const TaskView& task() const = 0;

  /// Sets the scene up, or takes the one that stands, and looks at it. From then on the task stays
  /// as it is.
  virtual Glimpse Begin() = 0;

  /// Of the simulated scene that was asked for or stands; -1: there is none, or nobody said it.
  virtual std::int64_t seed() const = 0;

  /// What is said of the scene; nothing where nobody says it.
  virtual std::optional<SceneLabel> label() const = 0;

  /// Carries an action out to its end.
  virtual ActionResult CarryOut(int action) = 0;

  /// The picture after the latest action that was begun.
  virtual Glimpse Look() = 0;

  /// All pictures of the episode, in order, as far as they are kept.
  virtual std::vector<Picture> Frames() const { return {}; }
};

}  // namespace prospect::agent

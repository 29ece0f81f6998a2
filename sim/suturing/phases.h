#pragma once

#include <array>
#include <optional>

#include "base/random.h"
#include "sim/suturing/motion.h"
#include "sim/suturing/parameters.h"
#include "sim/suturing/suturing_world.h"
#include "sim/suturing/thread.h"

namespace prospect::sim {

// How one surgeon differs from another: factors on times and on deviations.
struct SurgeonStyle {
  double pace = 1;    // on durations
  double wander = 1;  // on the deviation of paths
  double noise = 1;   // on where a hand ends
};

// What is known of the suture besides the bodies. Plain data.
struct Suture {
  SuturingThread thread;
  bool misplaced = false;  // it went in too far from its dot
  bool in_tissue() const { return thread.entered; }
  int throws() const { return thread.passed; }  // stitches made
};

// What happens when a phase ends.
enum class PhaseEvent {
  kNone,
  kRightTakes,        // the right jaws close about the needle
  kLeftTakes,         // the left ones
  kLetGo,             // the needle is free
  kEnters,            // its tip goes into the tissue
  kPasses,            // its tail has come out: one stitch more
  kRightTakesThread,  // the right jaws close about the thread
};

// What the thread does during a phase.
enum class ThreadRule { kKeep, kTighten, kLoosen };

// A gesture is a sequence of phases: both hands move at once, then something happens.
struct Phase {
  double seconds = 0;
  std::array<HandMove, 2> hands;
  PhaseEvent event = PhaseEvent::kNone;
  ThreadRule thread = ThreadRule::kKeep;
};

// What a phase is planned from: the world, and where the hands are wanted now.
struct Situation {
  const SuturingWorld& world;
  const Suture& suture;
  std::array<HandMove, 2> last;  // `to` and `opening` hold
  bool began_in_tissue = false;  // the needle was in the tissue when the gesture began
};

// Phase `index` of `gesture` from where things are, with deviations drawn from `random`; none after
// the gesture's last. A needle that is held goes where it should be with the grip that it has.
std::optional<Phase> PlanPhase(int gesture, int index, const Situation& situation,
                               const SuturingParameters& p, const SurgeonStyle& style,
                               base::Random random);

// A hand at `at` whose jaws point along `tool` and open sideways.
Eigen::Isometry3d HandPose(const Eigen::Vector3d& at, const Eigen::Vector3d& tool);

// Where the hands rest between throws, hand 0 or 1.
Eigen::Isometry3d RestPose(int hand);

}  // namespace prospect::sim

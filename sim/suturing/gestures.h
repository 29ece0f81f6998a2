#pragma once

#include <vector>

#include "base/random.h"
#include "sim/task.h"

namespace prospect::sim {

// The surgical gestures of the JIGSAWS vocabulary (Gao et al. 2014), G1 to G15. The action table
// has all fifteen, index = number - 1, so that a network trained on any task of that data set fits;
// the suturing task uses ten of them, the others are never legal here and have no successors.
enum Gesture {
  kReachRight = 0,  // G1 reaching for the needle with the right hand
  kPosition = 1,    // G2 positioning the needle: its tip on the entry point
  kPush = 2,        // G3 pushing the needle through the tissue; the left hand takes its tip
  kTransfer = 3,    // G4 transferring the needle from the left hand to the right
  kCenter = 4,      // G5 moving to the centre with the needle in the grip
  kPullLeft = 5,    // G6 pulling the suture with the left hand
  kOrient = 7,      // G8 orienting the needle
  kTighten = 8,     // G9 using the right hand to help tighten the suture
  kLoosen = 9,      // G10 loosening more suture
  kDrop = 10,       // G11 dropping the suture at the end and moving to the end points
};
inline constexpr int kGestures = 15;

// Names "G1" to "G15"; kinds in words.
std::vector<ActionSpec> SuturingActions();

// TaskSpec::successors. Which gesture may follow which is ours: the typical order of a throw (G2,
// G3, G6, G4) with the detours that surgeons make, shaped on the published vocabulary.
std::vector<std::vector<int>> SuturingSuccessors();

// What a surgeon does after `last` (kGestures: at the start) among `legal`, which must not be
// empty: a Markov chain over SuturingSuccessors, with weights of ours. Ends the trial (G11) only
// once all throws are `done`.
int ChooseGesture(int last, const std::vector<int>& legal, bool done, base::Random* random);

}  // namespace prospect::sim

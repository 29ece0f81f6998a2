#pragma once

#include <array>
#include <vector>

#include "model/engine.h"
#include "model/training/measures.h"
#include "tools/figures/held_out.h"
#include "tools/figures/loaded_model.h"

namespace prospect::figures {

/// What each head said beside what was true: [0] of states that were seen, [1] and [2] of those
/// imagined by one and by two transforms.
struct HeadRecord {
  std::array<model::Judgements, 3> v, q, p, f;
};

/// Adds one trial, with the labels that the heads are trained on (docs/training.md). Seen states
/// are those of the trial's first picture and of each action's end: there is where plans ask, and
/// how often f is right inside an action depends on how many frames from inside are asked about.
/// Imagined ones begin at the start of each action and follow what was done: one transform to the
/// end of that action, two to the end of the next. Q is asked of the action that was taken next, p
/// of all.
void AddJudgements(const SeenTrial& trial, model::Engine* engine, const DoneHead& done_head,
                   HeadRecord* record);

/// One of ten equal bins of predicted probability; 1 falls into the last.
struct Bin {
  int count = 0, trues = 0;
  double mean = 0;  ///< of the predictions in it
};
std::array<Bin, 10> Reliability(const model::Judgements& judgements);

/// Mean distance of prediction and observed frequency over the bins, each as heavy as its count.
double CalibrationError(const std::array<Bin, 10>& bins);

}  // namespace prospect::figures

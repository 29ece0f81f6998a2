#pragma once

#include <memory>
#include <vector>

#include "model/training/context.h"
#include "model/training/stage.h"

namespace prospect::model {

/// Labels of states, row by row, as V, Q, p and f are trained on. The networks are the same in both
/// kinds: each output is a probability of its own, trained by binary cross-entropy.
///
/// "paper" (docs/training.md):
///   V(h): did the trial succeed. f(h0, h, a): did the action succeed, on its goal picture or the
///   state imagined for it, and 0 on frames at least 0.3 s before its end. p(a' | h0, h, a): may a'
///   follow (samples.h, MayFollow). Q(h0, h, a, a'): did the trial succeed, for the a' that was
///   carried out next; other actions carry no loss. Inside an action p and Q are not asked.
/// "authors", their code's, for comparison: every frame bears the action carried out on it, and a
/// is the one of the frame before. V as above. f: 1 on the first frame of each action, else 0, so
/// also on a trial's last frame. p: the frame's action and no other, so inside an action that
/// action. Q: as p, times the trial's success: in failed trials no action at all.
class StateLabels {
 public:
  /// `inside_weight`: of f's loss on frames inside an action, beside 1 on its end.
  StateLabels(const SampleSet& samples, bool authors, double inside_weight = 1.0)
      : samples_(samples), authors_(authors), inside_weight_(static_cast<float>(inside_weight)) {}

  void AddFirst(int trial);   ///< the state before a trial's first action
  void AddGoal(int segment);  ///< the one on which an action ends, real or imagined
  void AddInside(int segment);

  std::vector<int> action;       ///< that led here; num_actions = none
  std::vector<float> value;      ///< V's label
  std::vector<float> done;       ///< f's; where f_weight is 0, any
  std::vector<float> f_weight;   ///< 0 before the first action
  std::vector<float> structure;  ///< 1 where p is asked, else 0
  std::vector<float> p, q;       ///< rows x actions; q: -1 = no loss

 private:
  void Add(int trial, int a, int next, bool asked);
  void AddDone(float is_done, float weight);

  const SampleSet& samples_;
  bool authors_;
  float inside_weight_;
};

/// Trains V, Q, p and f (separate networks, one loop) on encodings of real frames, and on states
/// imagined by the frozen T along whole plans, in shares (1 - imagined_share) and imagined_share of
/// the loss, without balancing: the outputs are to be probabilities.
std::unique_ptr<Stage> MakeHeadsStage(const TrainContext& context);

}  // namespace prospect::model

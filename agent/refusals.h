#pragma once

#include <optional>
#include <string>
#include <vector>

#include "agent/confidence.h"
#include "agent/listener.h"
#include "agent/mind.h"
#include "agent/options.h"
#include "agent/task_view.h"
#include "model/refusal/promise.h"

namespace prospect::agent {

/// By what the plans of one episode are refused, and how likely the others are to succeed, by what
/// the calibration of the weights says, where there is one. One thread; the mind must outlive it.
class Refusals {
 public:
  /// Looks whether a calibration holds for such scenes at all, which is said in a warning where
  /// none does, and chooses the threshold for what is to be promised. Throws PromiseError, and what
  /// Mind::Calibrations throws.
  Refusals(Mind& mind, const MindInfo& info, const EpisodeOptions& options,
           const model::SceneKind& kind, Listener& listener);

  /// By which searches were calibrated; empty: none were. A threshold holds for plans that were
  /// found as those it was taken from.
  const std::string& rule() const { return rule_; }

  /// Why the calibration says nothing of such scenes; empty: it does, or there is none.
  const std::string& not_covered() const { return not_covered_; }
  /// Plans that score less are refused.
  double threshold() const { return threshold_; }
  /// Why no plan may be begun, whatever it scores; empty: it may.
  std::string Objection() const;
  /// False: no threshold keeps what was promised.
  bool may_attempt() const { return promised_.may_attempt; }
  /// What was promised, a sentence each.
  const std::vector<std::string>& promises() const { return promised_.words; }

  /// What is told of refusals. @param goal whether a goal beyond the task's own was given
  std::optional<RefusalTerms> Terms(const EpisodeOptions& options, bool goal) const;
  /// In a plan with this score that is to be carried out. Only the first of an episode: calibration
  /// scenes were judged by their first search.
  std::optional<Confidence> ConfidenceIn(double score) const;

 private:
  double OwnThreshold(const MindInfo& info) const;

  // Of this kind of scenes; none where nobody calibrated on them.
  std::optional<model::CalibrationSample> sample_;
  std::string rule_;
  int plan_length_;
  std::string not_covered_;
  model::PromisedThreshold promised_;
  bool chosen_;  // by a person or for a promise: not the weights' own
  double threshold_;
};

}  // namespace prospect::agent

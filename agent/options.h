#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/novelty_words.h"
#include "model/refusal/promise.h"
#include "model/surprise.h"
#include "planner/search_parameters.h"

namespace prospect::agent {

/// What a person may ask of one episode, wherever it happens.
struct EpisodeOptions {
  std::string policy = "search";  ///< what decides, for the record
  /// The actions to carry out, asked for when the scene stands; null: they are searched for.
  std::function<std::vector<int>()> plan;
  std::string goal;  ///< what planner::ParseGoal reads; empty: the task's own
  /// Rule, constants, samples, depth (0: what remains). No rule: the one that the weights were
  /// calibrated with.
  planner::SearchParameters search;
  double refusal_threshold = -1;  ///< plans that score less are refused; negative: the weights' own
  int retries = 1;  ///< times a plan that is lost may be begun anew, where the task allows it
  double surprise = model::kSurprising;  ///< it is lost where a patch differs more than this
  model::Promise promise;  ///< asked for: sets refusal_threshold by the weights' calibration
  double novelty = model::kNoveltyLevel;  ///< pictures with a smaller p-value are refused; 0: none
  bool open_loop = false;     ///< the first plan is carried out as it is, without searching again
  bool explain_only = false;  ///< searches once, tells why, and carries nothing out
  bool explain = false;       ///< the record explains the first search
  bool illustrate = false;    ///< the record has pictures of every plan and of what was not chosen
  std::string what_if;        ///< names of actions; explained, too: what is expected of them
};

}  // namespace prospect::agent

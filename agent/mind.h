#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "agent/picture.h"
#include "agent/world.h"
#include "model/novelty_words.h"
#include "model/refusal/sample.h"
#include "planner/evaluation.h"
#include "planner/path.h"
#include "planner/plan.h"
#include "planner/search_parameters.h"
#include "planner/task_rules.h"

namespace prospect::agent {

/// The networks by which a mind judges.
struct MindInfo {
  std::string engine;            ///< "native avx512", "scripted"
  std::string weights;           ///< hash, 16 hexadecimal digits; empty: there are none
  double refusal_threshold = 0;  ///< the weights' own where no calibration tells of kinds of scenes
};

/// What is to be searched.
struct SearchQuestion {
  planner::TaskRules rules;              ///< with plan length and goal of this attempt, prepared
  planner::Path executed;                ///< of the actions carried out those that count
  std::vector<std::string> goal;         ///< planner::GoalTerms as words; none: the task's own
  planner::SearchParameters parameters;  ///< depth: at most what remains of the plan
  Glimpse first;                         ///< of the episode
  Glimpse present;
};

/// What a search came to.
struct SearchAnswer {
  planner::Plan plan;
  std::string ended_by;          ///< "samples", "exhausted", "deadline", "finished"
  std::int64_t rollouts = 0;     ///< of all workers
  std::int64_t evaluations = 0;  ///< distinct paths evaluated
  std::int64_t requested = 0;    ///< evaluations asked for and answered, summed over workers
  int workers = 1;
  bool converged = true;    ///< all that every live worker did is known
  std::uint64_t table = 0;  ///< hash of all that is known; 0: nobody has hashed it
  double seconds = 0;
  std::int64_t search_id = 0;  ///< names the search where others hear of it
  std::int32_t epoch = 0;
};

/// How unlike known pictures the root of the latest search is.
struct Recognition {
  /// None: nothing is known of known pictures, or nobody could be asked.
  std::optional<model::Novelty> novelty;
  Picture redrawn;  ///< what the networks make of the picture; empty: it did not come
  /// Why nobody could be asked: "no server answered within 3 s". Empty: somebody was.
  std::string defect;
};

/// Who imagines: a port that each host fills in, over a bus or in the same process. Called from one
/// thread. What ends an episode (services are lost or fall silent, somebody asks to stop) leaves
/// these functions as a std::exception.
class Mind {
 public:
  virtual ~Mind() = default;

  /// The networks that this episode will use; after World::Begin().
  virtual MindInfo Choose() = 0;

  /// How plans of these weights fared on calibration scenes, one sample for each kind of them; none
  /// where nobody knows, which throws where it is `needed`.
  virtual std::vector<model::CalibrationSample> Calibrations(bool needed) = 0;

  /// Finds a plan, or why there is none.
  virtual SearchAnswer Search(const SearchQuestion& question) = 0;

  /// What is thought of the states after `paths`, which the rules allow, from the root of the
  /// latest search on.
  virtual std::map<planner::Path, planner::Evaluation> Judge(
      const std::vector<planner::Path>& paths) = 0;

  /// What the world would look like after each of `paths` from there. A picture that cannot be had
  /// is missing.
  virtual std::map<planner::Path, Picture> Imagine(const std::vector<planner::Path>& paths) = 0;

  /// Whether the present picture of the latest search is like the known ones.
  virtual Recognition Familiar() = 0;
};

}  // namespace prospect::agent

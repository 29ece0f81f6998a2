#pragma once

#include <string>
#include <vector>

#include "planner/model_source.h"
#include "planner/plan.h"
#include "planner/search_parameters.h"
#include "tools/figures/task_table.h"

namespace prospect::figures {

/// What became of one future that a search imagined.
enum class Fate {
  kChosen,      ///< it is the plan
  kPossible,    ///< complete, but another one scores higher
  kNotDone,     ///< f < c_done
  kLowValue,    ///< V < v_failed
  kLowScore,    ///< complete, and below the refusal threshold
  kAllRefused,  ///< every action that may follow is rejected
  kUnfinished,  ///< the search ended before it did
};

/// One future in the order in which the search came to it.
struct Tried {
  planner::Path path;
  int number = 0;  ///< 1: the first
  Fate fate = Fate::kUnfinished;
  double score = 0;
  std::vector<planner::Evaluation> states;  ///< after each action
};

struct SearchStory {
  planner::Plan plan;
  std::vector<Tried> tried;  ///< each future once, in order
  std::int64_t rollouts = 0;
};

/// Runs one search over `model` and notes which futures it imagined, in turn: one that a rollout
/// went on to imagine step by step is one future.
SearchStory WatchSearch(const TaskTable& table, const planner::SearchParameters& parameters,
                        planner::ModelSource* model);

/// Whether `fate` ends a future as a failure.
bool IsRejection(Fate fate);

/// Those to be shown, at most `most`: the chosen one first, then one of each fate, then the first
/// ones; in order of trial.
std::vector<Tried> ChooseTried(const SearchStory& story, int most);

/// The reason in words, for `tried` of `story`.
std::string Verdict(const Tried& tried, const SearchStory& story,
                    const planner::SearchParameters& parameters);

}  // namespace prospect::figures

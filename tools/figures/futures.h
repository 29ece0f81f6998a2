#pragma once

#include <vector>

#include "model/engine.h"
#include "planner/model_source.h"
#include "planner/plan.h"
#include "planner/search_parameters.h"
#include "report/page.h"
#include "tools/figures/held_out.h"
#include "tools/figures/loaded_model.h"
#include "tools/figures/task_table.h"

namespace prospect::figures {

/// One imagined course of action from a scene's first picture.
struct Course {
  planner::Path path;
  std::vector<planner::Evaluation> states;  ///< after each action
  double score = 0;                         ///< V at the end times f along it
  planner::Rejection rejection = planner::Rejection::kNone;
  bool stuck = false;  ///< p permits nothing more although the plan is not complete
  bool failed() const { return stuck || rejection != planner::Rejection::kNone; }
};

/// Follows each first action that the task allows and p permits twice: by what Q likes best from
/// then on, and by what it likes least; twice the same course counts once. Courses end where the
/// plan is complete, or where they fail by the search's own thresholds. The best scores come first.
std::vector<Course> ParallelCourses(const TaskTable& table, planner::ModelSource* model,
                                    const planner::SearchParameters& parameters);

/// A scene and the courses imagined for it.
struct SceneFutures {
  sim::Image seen;
  std::uint64_t seed = 0;
  std::vector<Course> courses;
};

/// Looks at `most` held-out scenes in turn, in an order that `seed` decides, for one in which some
/// courses fail and others do not. The first scene if there is none such.
SceneFutures FindFutures(const HeldOut& held_out, const TaskTable& table, model::Engine* engine,
                         const planner::SearchParameters& parameters, int most, std::uint64_t seed);

/// futures.png: what would happen if, for several plans of one scene.
report::Page DrawFutures(const SceneFutures& scene, const TaskTable& table,
                         const LoadedModel& loaded, const planner::SearchParameters& parameters);

}  // namespace prospect::figures

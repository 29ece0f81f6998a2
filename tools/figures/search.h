#pragma once

#include <cstdint>

#include "model/engine.h"
#include "planner/search_parameters.h"
#include "report/page.h"
#include "tools/figures/held_out.h"
#include "tools/figures/loaded_model.h"
#include "tools/figures/search_story.h"
#include "tools/figures/task_table.h"

namespace prospect::figures {

/// A scene and the search made from its picture.
struct SceneSearch {
  sim::Image seen;
  std::uint64_t seed = 0;
  SearchStory story;
};

/// Looks at `most` held-out scenes in turn, in an order that `seed` decides, for one whose search
/// finds a plan and rejects futures for at least two reasons; otherwise the one with most fates.
SceneSearch FindSearch(const HeldOut& held_out, const TaskTable& table, model::Engine* engine,
                       const planner::SearchParameters& parameters, int most, std::uint64_t seed);

/// search.png: the plan that was chosen, what else was imagined first, and why it was not chosen.
report::Page DrawSearch(const SceneSearch& scene, const TaskTable& table, const LoadedModel& loaded,
                        const planner::SearchParameters& parameters);

}  // namespace prospect::figures

#pragma once

#include <cstdint>

#include "report/page.h"
#include "tools/figures/loaded_model.h"
#include "tools/figures/task_table.h"

namespace prospect::figures {

/// random-states.png: hidden states drawn uniformly at random, and the same after 200 transforms
/// (T(h0, h, a) with h0 the random one, actions at random as the task's graph lets them follow), as
/// channel means and decoded, in the light of `scene`, a picture that was seen: the paper's figure
/// of randomly sampled hidden states.
report::Page DrawRandomStates(const TaskTable& table, const LoadedModel& loaded,
                              const sim::Image& scene, std::uint64_t seed);

}  // namespace prospect::figures

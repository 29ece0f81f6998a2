#pragma once

#include "report/page.h"
#include "tools/figures/held_out.h"
#include "tools/figures/loaded_model.h"
#include "tools/figures/task_table.h"

namespace prospect::figures {

/// hidden-states.png: along one trial, the picture at each segment's start and at the end, the
/// encoder's hidden state of it as channel mean, and its decoding. Long trials take several bands.
report::Page DrawHiddenStates(const SeenTrial& trial, const TaskTable& table,
                              const LoadedModel& loaded);

}  // namespace prospect::figures

#pragma once

#include <vector>

#include "model/engine.h"
#include "planner/path.h"
#include "report/heat_map.h"
#include "sim/image.h"
#include "tools/figures/loaded_model.h"

namespace prospect::figures {

/// The states along `path` from `h`, the start left out: T(h0, h, a) again and again.
std::vector<model::Hidden> StatesAlong(model::Engine* engine, const model::Hidden& h0,
                                       model::Hidden h, const planner::Path& path);

/// What the model imagines after each action of `path` from the picture `seen`, in the light of the
/// episode's `first`.
std::vector<sim::Image> PicturesAlong(const LoadedModel& loaded, const sim::Image& first,
                                      const sim::Image& seen, const planner::Path& path);

/// A hidden state's channel mean at each place of its grid, which is the picture's divided by 8.
report::ValueGrid MeanOverChannels(const model::EngineInfo& info, const model::Hidden& state);

}  // namespace prospect::figures

#pragma once

#include <vector>

#include "model/engine.h"
#include "planner/path.h"
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

/// A hidden state's channel mean at each place of its grid, row by row. The grid is the picture's,
/// divided by 8.
struct ChannelMean {
  int width = 0, height = 0;
  std::vector<float> values;
};
ChannelMean MeanOverChannels(const model::EngineInfo& info, const model::Hidden& state);

/// The lowest and the highest of several means.
struct Range {
  double low = 0, high = 1;
};
Range RangeOf(const std::vector<ChannelMean>& means);

/// A pixel for each place, `range` from dark to bright.
sim::Image HeatMap(const ChannelMean& mean, const Range& range);

/// Mean absolute difference of two pictures of one size, as a share of full range.
double MeanAbsoluteError(const sim::Image& a, const sim::Image& b);

}  // namespace prospect::figures

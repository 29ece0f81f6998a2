#include "tools/figures/imagined.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "tools/figures/color.h"

namespace prospect::figures {

std::vector<model::Hidden> StatesAlong(model::Engine* engine, const model::Hidden& h0,
                                       model::Hidden h, const planner::Path& path) {
  std::vector<model::Hidden> states;
  for (const int action : path) {
    h = engine->Expand({{h0, h, action}}).front().h;
    states.push_back(h);
  }
  return states;
}

std::vector<sim::Image> PicturesAlong(const LoadedModel& loaded, const sim::Image& first,
                                      const sim::Image& seen, const planner::Path& path) {
  model::Engine* engine = loaded.engine.get();
  const model::Hidden h0 = engine->Encode(first.rgb);
  const model::Hidden start = engine->Encode(seen.rgb);
  return loaded.paint(first, h0, StatesAlong(engine, h0, start, path));
}

ChannelMean MeanOverChannels(const model::EngineInfo& info, const model::Hidden& state) {
  ChannelMean mean{info.image_width / 8, info.image_height / 8, {}};
  const auto places = static_cast<std::size_t>(mean.width) * mean.height;
  const std::size_t channels = state.size() / places;
  mean.values.assign(places, 0.0F);
  for (std::size_t i = 0; i < channels * places; ++i) {
    mean.values[i % places] += state[i] / static_cast<float>(channels);
  }
  return mean;
}

Range RangeOf(const std::vector<ChannelMean>& means) {
  Range range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const ChannelMean& mean : means) {
    for (const float value : mean.values) {
      range.low = std::min(range.low, static_cast<double>(value));
      range.high = std::max(range.high, static_cast<double>(value));
    }
  }
  return range;
}

sim::Image HeatMap(const ChannelMean& mean, const Range& range) {
  const double span = std::max(1e-9, range.high - range.low);
  sim::Image image{mean.width, mean.height, {}};
  for (const float value : mean.values) {
    const Color color = HeatColor((value - range.low) / span);
    image.rgb.insert(image.rgb.end(), {color.r, color.g, color.b});
  }
  return image;
}

double MeanAbsoluteError(const sim::Image& a, const sim::Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
  return a.rgb.empty() ? 0 : sum / 255 / static_cast<double>(a.rgb.size());
}

}  // namespace prospect::figures

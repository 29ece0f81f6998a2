#include "tools/figures/imagined.h"

#include <utility>

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

report::ValueGrid MeanOverChannels(const model::EngineInfo& info, const model::Hidden& state) {
  report::ValueGrid mean{info.image_width / 8, info.image_height / 8, {}};
  const auto places = static_cast<std::size_t>(mean.width) * mean.height;
  const std::size_t channels = state.size() / places;
  mean.values.assign(places, 0.0F);
  for (std::size_t i = 0; i < channels * places; ++i) {
    mean.values[i % places] += state[i] / static_cast<float>(channels);
  }
  return mean;
}

}  // namespace prospect::figures

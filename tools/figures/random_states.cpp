#include "tools/figures/random_states.h"

#include <algorithm>

#include "base/random.h"
#include "report/heat_map.h"
#include "tools/figures/imagined.h"

namespace prospect::figures {

using namespace report;

namespace {

constexpr int kColumns = 7, kTransforms = 200;
constexpr int kColumn = kSide + 14, kLabel = 110, kScale = 64;

model::Hidden DrawState(int size, std::uint64_t seed) {
  base::Random random(seed);
  model::Hidden state(static_cast<std::size_t>(size));
  for (float& value : state) value = static_cast<float>(random.Uniform());
  return state;
}

struct Column {
  sim::Image before, after;
  ValueGrid mean_before, mean_after;
};

Column MakeColumn(const TaskTable& table, const LoadedModel& loaded, const sim::Image& scene,
                  std::uint64_t seed) {
  const model::EngineInfo& info = loaded.engine->info();
  const model::Hidden start = DrawState(info.hidden_size, seed);
  planner::Path walk;
  for (const int action : RandomWalk(table.rules, kTransforms, seed)) {
    walk.push_back(static_cast<std::uint8_t>(action));
  }
  const model::Hidden end = StatesAlong(loaded.engine.get(), start, start, walk).back();
  const auto pictures = loaded.paint(scene, loaded.engine->Encode(scene.rgb), {start, end});
  return {pictures[0], pictures[1], MeanOverChannels(info, start), MeanOverChannels(info, end)};
}

void DrawColumn(Canvas* sheet, int x, int y, const Column& column, const Range& range) {
  const int factor = FactorFor(std::max(column.before.width, column.before.height));
  const int step = kSide + 10;
  DrawHeat(sheet, x, y, column.mean_before, range);
  sheet->Picture(x, y + step, column.before, factor);
  DrawHeat(sheet, x, y + 2 * step, column.mean_after, range);
  sheet->Picture(x, y + 3 * step, column.after, factor);
}

}  // namespace

Page DrawRandomStates(const TaskTable& table, const LoadedModel& loaded, const sim::Image& scene,
                      std::uint64_t seed) {
  std::vector<Column> columns;
  std::vector<ValueGrid> means;
  for (int i = 0; i < kColumns; ++i) {
    columns.push_back(
        MakeColumn(table, loaded, scene, base::MixSeeds({seed, static_cast<std::uint64_t>(i)})));
    means.push_back(columns.back().mean_before);
    means.push_back(columns.back().mean_after);
  }
  const Range range = RangeOf(means);
  Canvas sheet(2 * kMargin + kLabel + kColumns * kColumn + kScale);
  const int y = DrawHeading(&sheet, "What transforms make of noise: " + loaded.engine->info().task);
  const char* labels[] = {"random hidden state", "its decoding", "after 200 transforms",
                          "its decoding"};
  const int step = kSide + 10;
  for (int row = 0; row < 4; ++row) {
    sheet.Paragraph(kMargin, y + row * step + kSide / 2 - 20, kLabel - 12, labels[row], kBodyStyle);
  }
  int x = kMargin + kLabel;
  for (const Column& column : columns) {
    DrawColumn(&sheet, x, y, column, range);
    x += kColumn;
  }
  DrawScale(&sheet, x, y, range);
  DrawScale(&sheet, x, y + 2 * step, range);
  return Finish(
      &sheet, y + 4 * step, "random-states.png",
      "A column each: a hidden state whose numbers are drawn uniformly from 0 to 1, shown as "
      "channel mean; its decoding; the hidden state after 200 transforms T(h0, h, a), with the "
      "random state as h0 throughout and random actions in an order that the task allows; its "
      "decoding. The more it looks like a scene, the more the transform draws any state towards "
      "those that pictures have.");
}

}  // namespace prospect::figures

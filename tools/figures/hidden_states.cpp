#include "tools/figures/hidden_states.h"

#include <algorithm>

#include "report/heat_map.h"
#include "tools/figures/imagined.h"

namespace prospect::figures {

using namespace report;

namespace {

constexpr int kColumn = kSide + 14, kLabel = 84, kScale = 64;
constexpr int kMostColumns = 10;

struct Column {
  std::string above;
  sim::Image seen, decoded;
  ValueGrid mean;
};

Column MakeColumn(const SeenTrial& trial, int slot, const std::string& above,
                  const LoadedModel& loaded) {
  const sim::Image& first = trial.seen[static_cast<std::size_t>(trial.trial().first)];
  const sim::Image& seen = trial.seen[static_cast<std::size_t>(slot)];
  const model::Hidden h0 = loaded.engine->Encode(first.rgb);
  const model::Hidden state = loaded.engine->Encode(seen.rgb);
  return {above, seen, loaded.paint(first, h0, {state}).front(),
          MeanOverChannels(loaded.engine->info(), state)};
}

std::vector<Column> Columns(const SeenTrial& trial, const TaskTable& table,
                            const LoadedModel& loaded) {
  std::vector<Column> columns;
  int number = 0;
  for (const model::SegmentSample& segment : trial.segments()) {
    columns.push_back(MakeColumn(trial, segment.start,
                                 std::to_string(++number) + ". " + table.Name(segment.action),
                                 loaded));
  }
  const std::string end = trial.labels.succeeded() ? "end: success" : "end: failure";
  columns.push_back(MakeColumn(trial, trial.segments().back().goal, end, loaded));
  return columns;
}

// Columns from `first` on. Returns the y below.
int DrawBand(Canvas* sheet, int y, const std::vector<Column>& columns, std::size_t first,
             const Range& range) {
  const std::size_t end = std::min(columns.size(), first + kMostColumns);
  const int top = y + 2 * Canvas::LineHeight(kBodyStyle) + 4;
  const int step = kSide + 10;
  const char* labels[] = {"picture", "hidden state", "decoding"};
  for (int row = 0; row < 3; ++row) {
    sheet->Paragraph(kMargin, top + row * step + kSide / 2 - 16, kLabel - 10, labels[row],
                     kBodyStyle);
  }
  int x = kMargin + kLabel;
  for (std::size_t i = first; i < end; ++i, x += kColumn) {
    const Column& column = columns[i];
    const int factor = FactorFor(std::max(column.seen.width, column.seen.height));
    sheet->Paragraph(x, y, kColumn - 6, column.above, kBodyStyle);
    sheet->Picture(x, top, column.seen, factor);
    DrawHeat(sheet, x, top + step, column.mean, range);
    sheet->Picture(x, top + 2 * step, column.decoded, factor);
  }
  DrawScale(sheet, x, top + step, range);
  return top + 3 * step + 6;
}

std::string Caption(const SeenTrial& trial, const model::EngineInfo& info) {
  const int places = (info.image_width / 8) * (info.image_height / 8);
  return "Along one held-out trial (seed " + std::to_string(trial.labels.seed) +
         "). Upper row: what the camera saw when each action began, the action above it, and at "
         "the end. Middle row: what the encoder makes of it, " +
         std::to_string(info.image_width / 8) + "x" + std::to_string(info.image_height / 8) +
         " places with " + std::to_string(info.hidden_size / places) +
         " channels, here their mean at each place (the scale at the right; the encoder's numbers "
         "lie between 0 and 1). Lower row: what the decoder paints from that hidden state alone, "
         "in "
         "the light of the first picture, since hidden states do not hold how bright a scene is.";
}

}  // namespace

Page DrawHiddenStates(const SeenTrial& trial, const TaskTable& table, const LoadedModel& loaded) {
  const std::vector<Column> columns = Columns(trial, table, loaded);
  std::vector<ValueGrid> means;
  for (const Column& column : columns) means.push_back(column.mean);
  const Range range = RangeOf(means);
  const int across = static_cast<int>(std::min<std::size_t>(columns.size(), kMostColumns));
  Canvas sheet(2 * kMargin + kLabel + across * kColumn + kScale);
  int y = DrawHeading(&sheet, "What the encoder keeps of a picture: " + trial.labels.task);
  for (std::size_t i = 0; i < columns.size(); i += kMostColumns) {
    y = DrawBand(&sheet, y, columns, i, range);
  }
  return Finish(&sheet, y, "hidden-states.png", Caption(trial, loaded.engine->info()));
}

}  // namespace prospect::figures

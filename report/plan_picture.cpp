#include "report/plan_picture.h"

#include <algorithm>

#include "base/number_format.h"
#include "report/canvas.h"
#include "report/episode_report.h"
#include "report/page.h"
#include "report/png.h"

namespace prospect::report {

using namespace agent;

namespace {

// Pixels.
constexpr int kGap = 22;
constexpr int kLabelWidth = 128;
constexpr int kPicture = 256;
constexpr int kLeastPlanWidth = 1000;

constexpr Style kTitle{0.85, kInk, false};
constexpr Style kBody{0.5, kInk, false};
constexpr Style kHeading{0.6, kInk, false};
constexpr Style kStepTitle{0.54, kInk, false};
constexpr Style kSmall{0.42, kFaint, false};

// One column: a step, or the start.
struct Column {
  std::string title;
  sim::Image far;   // imagined before the first action
  sim::Image near;  // imagined one step ahead
  sim::Image observed;
  std::string far_name;  // of the action imagined then, when it was another one
  std::vector<std::string> figures;
  std::string verdict;
  Color verdict_color = kInk;
  std::string note;  // what was not as usual about the search before it
};

// The left side of a band's column. A band is as many columns as stand side by side; more go on
// below it.
int Left(int column) { return kMargin + kLabelWidth + column * (kPicture + kGap); }

using Band = std::vector<Column>;

Color OutcomeColor(const std::string& outcome) {
  if (outcome == "solved") return kGood;
  return outcome == "refused" ? kDoubt : kBad;
}

std::vector<std::string> Figures(const TableRow& row) {
  if (!row.searched) return {};
  const auto& step = row.imagined;
  return {base::Number("score %.3f", step.score),
          base::Number("V %.3f", step.value) + base::Number("   f %.3f", step.done),
          std::to_string(step.visits) + " visits"};
}

std::string Observed(const TableRow& row, const EpisodeRecord& record) {
  if (row.observed.empty()) return "not carried out";
  const auto& act = record.acts[static_cast<std::size_t>(row.step) - 1];
  const std::string text = row.observed + base::Number(" after %.1f s", act.sim_seconds);
  return act.reason.empty() ? text : text + ": " + act.reason;
}

// Step `row` as it was imagined before the first action, if the first plan went that far.
const StepRecord* FarStep(const EpisodeRecord& record, int step) {
  if (record.searches.empty()) return nullptr;
  const auto& plan = record.searches.front().steps;
  const auto index = static_cast<std::size_t>(step) - 1;
  return index < plan.size() ? &plan[index] : nullptr;
}

Column StepColumn(const TableRow& row, const EpisodeRecord& record) {
  Column column;
  column.title = std::to_string(row.step) + ". " + row.imagined.name;
  if (const StepRecord* far = FarStep(record, row.step)) {
    column.far = far->imagined;
    if (far->name != row.imagined.name) column.far_name = "planned: " + far->name;
  }
  const auto index = static_cast<std::size_t>(row.step) - 1;
  // One step ahead only where a search began with this very step.
  if (index < record.searches.size() && index > 0) column.near = row.imagined.imagined;
  if (index < record.acts.size()) column.observed = record.acts[index].picture;
  column.figures = Figures(row);
  column.verdict = Observed(row, record);
  column.note = row.note;
  column.verdict_color = row.observed == "succeeded" ? kGood : row.observed.empty() ? kFaint : kBad;
  return column;
}

std::vector<Column> Columns(const EpisodeRecord& record) {
  Column start;
  start.title = "Start";
  start.observed = record.first;
  start.verdict = "what the camera saw first";
  start.verdict_color = kFaint;
  std::vector<Column> columns{start};
  for (const auto& row : TableRows(record)) columns.push_back(StepColumn(row, record));
  return columns;
}

void DrawRule(Canvas& canvas, int y) {
  canvas.Line(kMargin, y, canvas.width() - kMargin, y, kRule, 1);
}

int DrawHeader(Canvas& canvas, const EpisodeRecord& record) {
  const int width = canvas.width() - 2 * kMargin;
  int y = canvas.Text(kMargin, kMargin, "Prospect: " + record.task + ", " + SceneWords(record.seed),
                      kTitle);
  y = canvas.Paragraph(kMargin, y + 2, width, VerdictSentence(record),
                       {0.6, OutcomeColor(record.outcome), false});
  if (record.searches.empty()) return y + 10;
  const auto& search = record.searches.front();
  std::string words = search.act ? "Before setting out, the plan scored "
                                 : "The best that could be imagined scores ";
  words += base::Number("%.2f", search.score);
  if (search.threshold > 0)
    words += base::Number(" (plans below %.2f are refused)", search.threshold);
  words += ", from " + std::to_string(search.rollouts) + " imagined courses of action over " +
           std::to_string(search.evaluations) + " imagined states.";
  return canvas.Paragraph(kMargin, y, width, words, kBody) + 10;
}

// One row of pictures.
struct Row {
  sim::Image Column::*which;
  const char* label;
  const char* note;
  const char* story;  // told in the first column where it has no picture
  Color color;
};

const Row kRows[] = {
    {&Column::far, "Imagined", "before setting out",
     "From this one picture the networks imagined what each action would do, one after the other, "
     "and chose the sequence most likely to succeed.",
     kMark},
    {&Column::near, "Imagined again", "just before the action",
     "After each action the robot looked again and searched anew from what it saw.", kMark},
    {&Column::observed, "What happened", "camera at the end of the action", "", kInk},
};

void DrawCell(Canvas& canvas, const Row& row, const Column& column, int x, int y) {
  if (!(column.*row.which).empty()) canvas.Framed(x, y, kPicture, column.*row.which, row.color);
  if (row.which == &Column::far) canvas.Text(x, y + kPicture + 3, column.far_name, kSmall);
}

// Draws nothing when no column has a picture.
int DrawRow(Canvas& canvas, const Band& band, const Row& row, bool first, int y) {
  const auto shown = [&](const Column& column) { return !(column.*row.which).empty(); };
  if (std::none_of(band.begin(), band.end(), shown)) return y;
  const int below =
      canvas.Paragraph(kMargin, y, kLabelWidth - 14, row.label, {0.5, row.color, false});
  canvas.Paragraph(kMargin, below + 4, kLabelWidth - 14, row.note, kSmall);
  if (first && !shown(band.front())) canvas.Paragraph(Left(0), y, kPicture - 10, row.story, kSmall);
  bool named = false;
  for (std::size_t i = 0; i < band.size(); ++i) {
    DrawCell(canvas, row, band[i], Left(static_cast<int>(i)), y);
    named = named || (row.which == &Column::far && !band[i].far_name.empty());
  }
  return y + kPicture + kGap + (named ? 12 : 0);
}

int DrawTitles(Canvas& canvas, const Band& band, int y) {
  int bottom = y;
  for (std::size_t i = 0; i < band.size(); ++i) {
    const int x = Left(static_cast<int>(i));
    bottom = std::max(bottom, canvas.Paragraph(x, y, kPicture, band[i].title, kStepTitle));
  }
  return bottom + 6;
}

int DrawFigures(Canvas& canvas, const Band& band, int y) {
  int bottom = y;
  for (std::size_t i = 0; i < band.size(); ++i) {
    const Column& column = band[i];
    const int x = Left(static_cast<int>(i));
    int line = canvas.Paragraph(x, y, kPicture, column.verdict, {0.5, column.verdict_color, false});
    line = canvas.Paragraph(x, line, kPicture, column.note, {0.42, kDoubt, false});
    for (const auto& figure : column.figures) line = canvas.Text(x, line, figure, kBody);
    bottom = std::max(bottom, line);
  }
  return bottom + 12;
}

int DrawSteps(Canvas& canvas, const std::vector<Column>& columns, std::size_t per_band, int y) {
  for (std::size_t at = 0; at < columns.size(); at += per_band) {
    const std::size_t end = std::min(columns.size(), at + per_band);
    const Band band(columns.begin() + static_cast<std::ptrdiff_t>(at),
                    columns.begin() + static_cast<std::ptrdiff_t>(end));
    DrawRule(canvas, y);
    y = DrawTitles(canvas, band, y + 12);
    for (const Row& row : kRows) y = DrawRow(canvas, band, row, at == 0, y);
    y = DrawFigures(canvas, band, y);
  }
  return y;
}

std::string Chain(const std::vector<std::string>& names) {
  std::string chain;
  for (const auto& name : names) chain += (chain.empty() ? "" : ", then ") + name;
  return chain;
}

int DrawOther(Canvas& canvas, const FutureRecord& other, int x, int y, int side, int width) {
  canvas.Framed(x, y + 2, side, other.imagined, other.rejected ? kBad : kRule);
  const int below =
      canvas.Paragraph(x, y + side + 10, width, Chain(other.names), {0.42, kInk, false});
  return canvas.Paragraph(x, below, width, other.why,
                          {0.42, other.rejected ? kBad : kFaint, false});
}

// Actions ruled out from the start were never imagined: one line names them.
int DrawRuledOut(Canvas& canvas, const std::vector<FutureRecord>& others, int y) {
  std::string names;
  for (const auto& other : others) {
    if (other.imagined.empty()) names += (names.empty() ? "" : ", ") + other.names.front();
  }
  if (names.empty()) return y;
  return canvas.Paragraph(kMargin, y, canvas.width() - 2 * kMargin,
                          "Ruled out from the start, without imagining them: " + names, kSmall) +
         8;
}

int DrawOthers(Canvas& canvas, const EpisodeRecord& record, int y) {
  if (record.searches.empty() || record.searches.front().others.empty()) return y;
  const auto& search = record.searches.front();
  DrawRule(canvas, y);
  const char* heading = search.act ? "Other first actions, and why they were not chosen"
                                   : "What else was imagined, and why it was rejected";
  y = canvas.Text(kMargin, y + 12, heading, kHeading) + 6;
  constexpr int kSmallSide = 128, kCell = kSmallSide + 48;
  const int per_row = std::max(1, (canvas.width() - 2 * kMargin) / kCell);
  int bottom = y, shown = 0;
  for (const auto& other : search.others) {
    if (other.imagined.empty()) continue;
    const int column = shown++ % per_row;
    if (shown > 1 && column == 0) y = bottom + 12;
    bottom = std::max(
        bottom, DrawOther(canvas, other, kMargin + 2 + column * kCell, y, kSmallSide, kCell - 16));
  }
  return DrawRuledOut(canvas, search.others, bottom + 8) + 4;
}

int DrawLegend(Canvas& canvas, const EpisodeRecord& record, int y) {
  if (record.searches.empty()) return y;
  DrawRule(canvas, y);
  return canvas.Paragraph(kMargin, y + 10, canvas.width() - 2 * kMargin,
                          "score: imagined chance that all goes well up to and after this step (V "
                          "times f of every step so far). "
                          "V: imagined chance of success from that state on. f: imagined chance "
                          "that the action gets done. "
                          "p: whether an action is possible at all. visits: how many imagined "
                          "courses of action went through. "
                          "Figures of a step are those of the search made just before it.",
                          kSmall) +
         kMargin / 2;
}

}  // namespace

void WritePlanPicture(const EpisodeRecord& record, const std::string& path) {
  const std::vector<Column> columns = Columns(record);
  const int per_band =
      Canvas::PerRow(static_cast<int>(columns.size()), kPicture + kGap, Left(0) + kMargin);
  Canvas canvas(std::max(kLeastPlanWidth, Left(per_band) + kMargin));
  int y = DrawHeader(canvas, record);
  y = DrawSteps(canvas, columns, static_cast<std::size_t>(per_band), y);
  y = DrawOthers(canvas, record, y);
  y = DrawLegend(canvas, record, y);
  WritePng(path, canvas.Cut(y));
}

}  // namespace prospect::report

#include "report/scaling_plot.h"

#include <algorithm>
#include <cmath>

#include "base/number_format.h"
#include "report/page.h"
#include "report/plot.h"
#include "report/png.h"

namespace prospect::report {
namespace {

using nlohmann::json;

constexpr int kWidth = 560, kHeight = 400;  // with room at the right for what is written at points
constexpr Style kBatchStyle{0.36, kInk, false};

double Workers(const json& row) { return row.at("workers").get<double>(); }
double Rate(const json& row) { return std::max(1e-3, row.at("rollouts_per_s").get<double>()); }

Axis WorkersAxis(const json& rows) {
  const double first = Workers(rows.front()), last = Workers(rows.back());
  return {first, std::max(last, 2 * first), Axis::Scale::kLogarithmic};
}

// From the power of two below the first point to the one above it, if it grows in proportion, and
// above every point.
Axis RateAxis(const json& rows, const Axis& workers) {
  const double low = std::floor(std::log2(Rate(rows.front())));
  double high = std::log2(Rate(rows.front())) + std::log2(workers.high / workers.low);
  for (const json& row : rows) high = std::max(high, std::log2(Rate(row)));
  return {std::exp2(low), std::exp2(std::ceil(high)), Axis::Scale::kLogarithmic};
}

void DrawGrid(Plot* plot, const Axis& rate, const json& rows) {
  for (double y = rate.low; y <= rate.high; y *= 2) plot->TickY(y, base::Number("%.0f", y));
  for (const json& row : rows) plot->TickX(Workers(row), base::Number("%.0f", Workers(row)));
  plot->Frame();
  plot->NameX("planner workers");
  plot->NameY("rollouts a second");
}

void DrawPoints(Plot* plot, Canvas* canvas, const json& rows) {
  const json* before = nullptr;
  for (const json& row : rows) {
    if (before != nullptr)
      plot->Line(Workers(*before), Rate(*before), Workers(row), Rate(row), kMark, 2);
    plot->Dot(Workers(row), Rate(row), 4, kMark);
    const std::string batch = base::Number("batch %.1f", row.at("mean_batch").get<double>());
    canvas->Text(plot->X(Workers(row)) + 8, plot->Y(Rate(row)) + 8, batch, kBatchStyle);
    before = &row;
  }
}

}  // namespace

void WriteScalingPlot(const std::string& path, const json& rows, const std::string& title) {
  Canvas canvas(std::max(kLeastWidth, 2 * kMargin + kPlotLeft + kWidth));
  const int y = DrawHeading(&canvas, title);
  const Axis workers = WorkersAxis(rows), rate = RateAxis(rows, workers);
  Plot plot(&canvas, kMargin + kPlotLeft, y, kWidth, kHeight, workers, rate);
  DrawGrid(&plot, rate, rows);
  const double first = Workers(rows.front()), growth = Rate(rows.front()) / first;
  plot.Line(first, growth * first, Workers(rows.back()), growth * Workers(rows.back()), kRule, 1);
  DrawPoints(&plot, &canvas, rows);
  const std::string caption =
      "Rollouts a second of the whole crew against its workers, both by doubling; grey: in "
      "proportion to the workers. At each point the mean batch of the model server.";
  WritePng(path, Captioned(&canvas, y + kHeight + kPlotBelow, caption));
}

}  // namespace prospect::report

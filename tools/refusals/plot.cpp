#include "tools/refusals/plot.h"

#include <algorithm>
#include <cmath>

#include "model/dataset.h"
#include "sim/png.h"
#include "tools/figures/page.h"

namespace prospect::tools {
namespace {

using figures::kFaint;
using figures::kMargin;
using figures::Number;
using figures::Sheet;
using figures::Style;
using nlohmann::json;

constexpr int kPlotWidth = 380, kPlotHeight = 260;
constexpr int kLeft = 56;      // numbers and name of the upright axis
constexpr int kPanelGap = 40;  // between panels
constexpr int kStrip = 72;     // height of the row of splits of one promise
constexpr Style kTickStyle{0.38, kFaint, false};
constexpr Style kNoteStyle{0.4, figures::kInk, false};

// Where (coverage, risk) lies on the sheet.
struct Axes {
  int left, top;
  double most_risk;
  int X(double coverage) const {
    return left + static_cast<int>(std::lround(coverage * kPlotWidth));
  }
  int Y(double risk) const {
    return top + kPlotHeight -
           static_cast<int>(std::lround(std::min(risk / most_risk, 1.0) * kPlotHeight));
  }
};

// The upright axis ends at the next twentieth above the promises and every point that stands on
// enough scenes.
double MostRisk(const std::vector<json>& all) {
  double most = 0.1;
  for (const json& figures : all) {
    most = std::max(most, figures["fail"]["target"].get<double>());
    for (const json& point : figures["curve"]) {
      if (point["coverage"].get<double>() >= 0.05)
        most = std::max(most, point["risk"].get<double>());
    }
  }
  return std::ceil(most * 20 + 0.2) / 20;
}

void DrawGrid(Sheet* sheet, const Axes& axes) {
  for (int i = 0; i <= 5; ++i) {
    const int x = axes.X(i / 5.0);
    sheet->Line(x, axes.top, x, axes.top + kPlotHeight, figures::kPale, 1);
    sheet->Centered(x, axes.top + kPlotHeight + 4, Number("%.0f %%", 20.0 * i), kTickStyle);
  }
  const int steps = static_cast<int>(std::lround(axes.most_risk * 20));
  for (int i = 0; i <= steps; ++i) {
    const double risk = i / 20.0;
    const std::string text = Number("%.0f %%", 100 * risk);
    sheet->Line(axes.X(0), axes.Y(risk), axes.X(1), axes.Y(risk), figures::kPale, 1);
    sheet->Text(axes.left - 6 - Sheet::TextWidth(text, kTickStyle), axes.Y(risk) - 7, text,
                kTickStyle);
  }
  sheet->Frame(axes.left, axes.top, kPlotWidth, kPlotHeight, kFaint, 1);
}

// A step curve: between two points nothing was measured.
void DrawCurve(Sheet* sheet, const Axes& axes, const json& curve) {
  const json* before = nullptr;
  for (const json& point : curve) {
    const int x = axes.X(point["coverage"]), y = axes.Y(point["risk"]);
    if (before != nullptr) {
      const int x0 = axes.X((*before)["coverage"]), y0 = axes.Y((*before)["risk"]);
      sheet->Line(x0, y0, x, y0, figures::kMark, 2);
      sheet->Line(x, y0, x, y, figures::kMark, 2);
    }
    before = &point;
  }
}

void DrawTarget(Sheet* sheet, const Axes& axes, double risk) {
  for (int x = axes.X(0); x < axes.X(1); x += 10)
    sheet->Line(x, axes.Y(risk), x + 5, axes.Y(risk), figures::kBad, 1);
}

// The rates of all splits as dots on a line from 0 to three times the target, which is marked.
void DrawSplits(Sheet* sheet, int left, int y, const char* what, const json& summary) {
  const double target = summary["target"], right = 3 * target;
  const auto at = [&](double rate) {
    return left + static_cast<int>(std::lround(std::min(rate / right, 1.0) * kPlotWidth));
  };
  sheet->Text(left, y - 34, what + Number(", promised at most %g %%:", 100 * target), kNoteStyle);
  sheet->Text(left, y - 16,
              Number("mean %.1f %%, ", 100 * summary["mean"].get<double>()) +
                  Number("%.0f of ", summary["within"].get<int>()) +
                  Number("%.0f splits in the 95 %% band", summary["kept"].get<int>()),
              kNoteStyle);
  sheet->Line(left, y + 12, left + kPlotWidth, y + 12, figures::kRule, 1);
  sheet->Line(at(target), y + 3, at(target), y + 21, figures::kBad, 2);
  for (const json& rate : summary["rates"]) sheet->Dot(at(rate), y + 12, 3, figures::kMark);
  sheet->Line(at(summary["mean"]), y + 5, at(summary["mean"]), y + 19, figures::kInk, 2);
}

// Returns the y below.
int DrawPanel(Sheet* sheet, int x, int y, double most_risk, const json& figures) {
  const Axes axes{x + kLeft, y + 24, most_risk};
  sheet->Centered(axes.X(0.5), y,
                  figures["task"].get<std::string>() + ", " +
                      std::to_string(figures["scenes"].get<int>()) + " scenes",
                  figures::kHeadStyle);
  DrawGrid(sheet, axes);
  DrawTarget(sheet, axes, figures["fail"]["target"]);
  DrawCurve(sheet, axes, figures["curve"]);
  sheet->TextUpwards(x + 2, axes.top + kPlotHeight / 2, "risk: failed of the attempted",
                     kTickStyle);
  sheet->Centered(axes.X(0.5), axes.top + kPlotHeight + 20, "coverage: attempted of all scenes",
                  kTickStyle);
  sheet->Text(axes.left, axes.top + kPlotHeight + 40,
              Number("area %.3f; ", figures["area"]) +
                  Number("solvable above hopeless (AUROC) %.3f", figures["auroc"]),
              kNoteStyle);
  const int below = axes.top + kPlotHeight + 108;
  DrawSplits(sheet, axes.left, below, "refused of the solvable", figures["refuse"]);
  DrawSplits(sheet, axes.left, below + kStrip, "failed of the attempted", figures["fail"]);
  return below + kStrip + 34;
}

}  // namespace

void PlotRefusals(const std::string& path, const std::vector<json>& all) {
  const int panel = kLeft + kPlotWidth;
  const int panels = static_cast<int>(all.size());
  Sheet sheet(
      std::max(figures::kLeastWidth, 2 * kMargin + panels * panel + (panels - 1) * kPanelGap));
  const double most_risk = MostRisk(all);
  int x = kMargin, y = kMargin;
  for (const json& figures : all) {
    y = std::max(y, DrawPanel(&sheet, x, kMargin, most_risk, figures));
    x += panel + kPanelGap;
  }
  const figures::Page page = figures::Finish(
      &sheet, y, "",
      "Above: what each threshold on the plan's score would have led to, from refusing all but the "
      "surest scenes (left) to attempting all for which there is a plan (right); the dashed line "
      "is "
      "the promised risk. Below: thresholds from one random half of the scenes, tried on the "
      "other; "
      "a dot a split, red the promise, black the mean.");
  try {
    sim::WritePng(path, page.picture);
  } catch (const std::runtime_error& error) {
    throw model::DiskError(std::string(error.what()) + ": check the folder and the space left");
  }
}

}  // namespace prospect::tools

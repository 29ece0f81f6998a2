#include "report/refusal_plot.h"

#include <algorithm>
#include <cmath>

#include "base/number_format.h"
#include "report/page.h"
#include "report/plot.h"
#include "report/png.h"

namespace prospect::report {
namespace {

using nlohmann::json;

constexpr int kPlotWidth = 380, kPlotHeight = 260;
constexpr int kPanelGap = 40;  // between panels
constexpr int kStrip = 72;     // height of the row of splits of one promise
constexpr Style kNoteStyle{0.4, kInk, false};

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

void DrawAxes(Plot* plot, double most_risk) {
  for (int i = 0; i <= 5; ++i) plot->TickX(i / 5.0, base::Number("%.0f %%", 20.0 * i));
  const int steps = static_cast<int>(std::lround(most_risk * 20));
  for (int i = 0; i <= steps; ++i) plot->TickY(i / 20.0, base::Number("%.0f %%", 5.0 * i));
  plot->Frame();
  plot->NameX("coverage: attempted of all scenes");
  plot->NameY("risk: failed of the attempted");
}

// A step curve: between two points nothing was measured.
void DrawCurve(Plot* plot, const json& curve) {
  const json* before = nullptr;
  for (const json& point : curve) {
    const double x = point["coverage"], y = point["risk"];
    if (before != nullptr) {
      const double x0 = (*before)["coverage"], y0 = (*before)["risk"];
      plot->Line(x0, y0, x, y0, kMark, 2);
      plot->Line(x, y0, x, y, kMark, 2);
    }
    before = &point;
  }
}

std::string InWords(const json& summary) {
  if (summary["kept"] == 0) return "in no split any threshold could promise it";
  return base::Number("mean %.1f %%, ", 100 * summary["mean"].get<double>()) +
         base::Number("%.0f of ", summary["within"].get<int>()) +
         base::Number("%.0f splits in the 95 %% band", summary["kept"].get<int>());
}

// The rates of all splits as dots on a line from 0 to three times the target, which is marked.
void DrawSplits(Canvas* canvas, int left, int y, const char* what, const json& summary) {
  const double target = summary["target"];
  const Axis axis{0, 3 * target, Axis::Scale::kLinear};
  const auto at = [&](double rate) {
    return left + static_cast<int>(std::lround(axis.Share(rate) * kPlotWidth));
  };
  canvas->Text(left, y - 34, what + base::Number(", promised at most %g %%:", 100 * target),
               kNoteStyle);
  canvas->Text(left, y - 16, InWords(summary), kNoteStyle);
  canvas->Line(left, y + 12, left + kPlotWidth, y + 12, kRule, 1);
  canvas->Line(at(target), y + 3, at(target), y + 21, kBad, 2);
  if (summary["kept"] == 0) return;
  for (const json& rate : summary["rates"]) canvas->Dot(at(rate), y + 12, 3, kMark);
  canvas->Line(at(summary["mean"]), y + 5, at(summary["mean"]), y + 19, kInk, 2);
}

// Returns the y below.
int DrawPanel(Canvas* canvas, int x, int y, double most_risk, const json& figures) {
  const int left = x + kPlotLeft, top = y + 24;
  Plot plot(canvas, left, top, kPlotWidth, kPlotHeight, {}, {0, most_risk, Axis::Scale::kLinear});
  canvas->Centered(plot.X(0.5), y,
                   figures["task"].get<std::string>() + ", " +
                       std::to_string(figures["scenes"].get<int>()) + " scenes",
                   kHeadStyle);
  DrawAxes(&plot, most_risk);
  plot.DashedLine(figures["fail"]["target"], kBad);
  DrawCurve(&plot, figures["curve"]);
  canvas->Text(left, top + kPlotHeight + kPlotBelow,
               base::Number("area %.3f; ", figures["area"]) +
                   base::Number("solvable above hopeless (AUROC) %.3f", figures["auroc"]),
               kNoteStyle);
  const int below = top + kPlotHeight + kPlotBelow + 68;
  DrawSplits(canvas, left, below, "refused of the solvable", figures["refuse"]);
  DrawSplits(canvas, left, below + kStrip, "failed of the attempted", figures["fail"]);
  return below + kStrip + 34;
}

}  // namespace

void WriteRefusalPlot(const std::string& path, const std::vector<json>& all) {
  const int panel = kPlotLeft + kPlotWidth;
  const int panels = static_cast<int>(all.size());
  Canvas canvas(std::max(kLeastWidth, 2 * kMargin + panels * panel + (panels - 1) * kPanelGap));
  const double most_risk = MostRisk(all);
  int x = kMargin, y = kMargin;
  for (const json& figures : all) {
    y = std::max(y, DrawPanel(&canvas, x, kMargin, most_risk, figures));
    x += panel + kPanelGap;
  }
  const std::string caption =
      "Above: what each threshold on the plan's score would have led to, from refusing all but the "
      "surest scenes (left) to attempting all for which there is a plan (right); the dashed line "
      "is the promised risk. Below: thresholds from one random half of the scenes, tried on the "
      "other; a dot a split, red the promise, black the mean.";
  WritePng(path, Captioned(&canvas, y, caption));
}

}  // namespace prospect::report

#include "tools/figures/calibration.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/number_format.h"
#include "report/plot.h"
#include "tools/common/interval.h"

namespace prospect::figures {

using namespace report;

namespace {

constexpr int kPlot = 240;  // the square of the curve
constexpr int kBars = 44;   // the height of the bars of counts
constexpr int kPanel = kPlotLeft + kPlot + 20;
constexpr int kFigures = 66;  // under the bars
constexpr int kPanelHeight = kPlot + kPlotBelow + 18 + kBars + kFigures;
constexpr int kName = 96;  // what the row is
constexpr Style kCountStyle{0.34, kFaint, false};

struct Head {
  const char* name;
  const char* what;
  std::array<model::Judgements, 3> HeadRecord::*judgements;
};

const Head kHeads[] = {
    {"V", "the task will succeed", &HeadRecord::v},
    {"Q", "success if this action is next", &HeadRecord::q},
    {"p", "this action may be next", &HeadRecord::p},
    {"f", "the action got done", &HeadRecord::f},
};

const char* const kRows[] = {"states that were seen", "after one transform",
                             "after two transforms"};

void DrawAxes(Plot* plot) {
  for (int i = 0; i <= 5; ++i) {
    plot->TickX(i / 5.0, base::Number("%.1f", i / 5.0));
    plot->TickY(i / 5.0, base::Number("%.1f", i / 5.0));
  }
  plot->Line(0, 0, 1, 1, kRule, 2);
  plot->Frame();
  plot->NameX("predicted probability");
  plot->NameY("observed frequency");
}

void DrawCurve(Plot* plot, const std::array<Bin, 10>& bins) {
  const Bin* before = nullptr;
  const auto share = [](const Bin& bin) { return tools::ShareOf(bin.trues, bin.count); };
  for (const Bin& bin : bins) {
    if (bin.count == 0) continue;
    const tools::Share here = share(bin);
    plot->Line(bin.mean, here.low, bin.mean, here.high, kMark, 1);
    if (before != nullptr)
      plot->Line(before->mean, share(*before).value, bin.mean, here.value, kMark, 2);
    plot->Dot(bin.mean, here.value, 4, kMark);
    before = &bin;
  }
}

// "940", "12k": room for four characters.
std::string Short(int count) {
  return count < 1000 ? std::to_string(count)
                      : base::Number(count < 9950 ? "%.1fk" : "%.0fk", count / 1000.0);
}

// Heights by the logarithm, because p's outermost bins hold nearly all.
void DrawBars(Canvas* sheet, const Plot& plot, int bottom, const std::array<Bin, 10>& bins) {
  int most = 1;
  for (const Bin& bin : bins) most = std::max(most, bin.count);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const int x = plot.X(static_cast<double>(i) / 10), width = kPlot / 10;
    const int height =
        static_cast<int>(std::lround(kBars * std::log1p(bins[i].count) / std::log1p(most)));
    sheet->Fill(x + 2, bottom - height, width - 4, height, kRule);
    sheet->Centered(x + width / 2, bottom - height - 15, Short(bins[i].count), kCountStyle);
  }
  sheet->Line(plot.X(0), bottom, plot.X(1), bottom, kFaint, 1);
}

void DrawPanel(Canvas* sheet, int x, int y, const model::Judgements& judgements) {
  Plot plot(sheet, x + kPlotLeft, y, kPlot, kPlot, {}, {});
  const std::array<Bin, 10> bins = Reliability(judgements);
  DrawAxes(&plot);
  DrawCurve(&plot, bins);
  const int bottom = y + kPlot + kPlotBelow + 18 + kBars;
  DrawBars(sheet, plot, bottom, bins);
  const int below = bottom + 4;
  const double base = model::BaseRate(judgements);
  sheet->Centered(plot.X(0.5), below,
                  "Brier " + base::Number("%.3f", model::BrierScore(judgements)) +
                      base::Number(" (base rate %.2f", base) +
                      base::Number(": %.3f)", base * (1 - base)),
                  {0.4, kInk, false});
  sheet->Centered(plot.X(0.5), below + 18,
                  std::to_string(judgements.size()) + " judgements, calibration error " +
                      base::Number("%.3f", CalibrationError(bins)),
                  {0.4, kInk, false});
}

std::string Caption(int trials) {
  return "How far the networks' probabilities hold, on " + std::to_string(trials) +
         " held-out trials: in ten bins of predicted probability, how often it came true (points, "
         "with 95 % intervals that take judgements as independent; on the diagonal they hold) and "
         "how many judgements fell into each bin (bars, on a logarithmic scale). Upper row: states "
         "that "
         "were seen, at the ends of actions; below: states "
         "imagined from there by what was then done, one and two actions further. Brier score: "
         "mean "
         "squared error, beside that of always answering the base rate. Calibration error: mean "
         "distance from the diagonal.";
}

}  // namespace

Page DrawCalibration(const HeadRecord& record, int trials, const std::string& task) {
  Canvas sheet(2 * kMargin + kName + static_cast<int>(std::size(kHeads)) * kPanel);
  int y = DrawHeading(&sheet, "Calibration of V, Q, p and f: " + task);
  int x = kMargin + kName;
  for (const Head& head : kHeads) {
    sheet.Centered(x + kPlotLeft + kPlot / 2, y, std::string(head.name) + ": " + head.what,
                   kBodyStyle);
    x += kPanel;
  }
  y += Canvas::LineHeight(kBodyStyle) + 6;
  for (std::size_t row = 0; row < std::size(kRows); ++row) {
    sheet.Paragraph(kMargin, y + kPlot / 2 - 30, kName - 10, kRows[row], kHeadStyle);
    x = kMargin + kName;
    for (const Head& head : kHeads) {
      DrawPanel(&sheet, x, y, (record.*head.judgements)[row]);
      x += kPanel;
    }
    y += kPanelHeight;
  }
  return Finish(&sheet, y - 20, "calibration.png", Caption(trials));
}

}  // namespace prospect::figures

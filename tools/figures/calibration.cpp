#include "tools/figures/calibration.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/common/interval.h"

namespace prospect::figures {
namespace {

constexpr int kPlot = 240;  // the square of the curve
constexpr int kBars = 44;   // the height of the bars of counts
constexpr int kLeft = 62;   // numbers and name of the upright axis
constexpr int kPanel = kLeft + kPlot + 20;
constexpr int kBelow = 40;    // between the square and the bars: numbers and name of the axis
constexpr int kFigures = 66;  // under the bars
constexpr int kPanelHeight = kPlot + kBelow + 18 + kBars + kFigures;
constexpr int kName = 96;  // what the row is
constexpr Style kTickStyle{0.38, kFaint, false};
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

// Where probabilities lie on the sheet.
struct Axes {
  int left, top;
  int X(double predicted) const { return left + static_cast<int>(std::lround(predicted * kPlot)); }
  int Y(double observed) const {
    return top + kPlot - static_cast<int>(std::lround(observed * kPlot));
  }
};

void DrawAxes(Sheet* sheet, const Axes& axes) {
  for (int i = 0; i <= 5; ++i) {
    const double at = i / 5.0;
    sheet->Line(axes.X(0), axes.Y(at), axes.X(1), axes.Y(at), kPale, 1);
    sheet->Line(axes.X(at), axes.Y(0), axes.X(at), axes.Y(1), kPale, 1);
    const std::string number = Number("%.1f", at);
    sheet->Text(axes.left - 8 - Sheet::TextWidth(number, kTickStyle), axes.Y(at) - 7, number,
                kTickStyle);
    sheet->Centered(axes.X(at), axes.top + kPlot + 3, number, kTickStyle);
  }
  sheet->Line(axes.X(0), axes.Y(0), axes.X(1), axes.Y(1), kRule, 2);
  sheet->Frame(axes.left, axes.top, kPlot, kPlot, kFaint, 1);
}

void DrawCurve(Sheet* sheet, const Axes& axes, const std::array<Bin, 10>& bins) {
  const Bin* before = nullptr;
  const auto share = [](const Bin& bin) { return tools::ShareOf(bin.trues, bin.count); };
  for (const Bin& bin : bins) {
    if (bin.count == 0) continue;
    const tools::Share here = share(bin);
    const int x = axes.X(bin.mean), y = axes.Y(here.value);
    sheet->Line(x, axes.Y(here.low), x, axes.Y(here.high), kMark, 1);
    if (before != nullptr) {
      sheet->Line(axes.X(before->mean), axes.Y(share(*before).value), x, y, kMark, 2);
    }
    sheet->Dot(x, y, 4, kMark);
    before = &bin;
  }
}

// "940", "12k": room for four characters.
std::string Short(int count) {
  return count < 1000 ? std::to_string(count)
                      : Number(count < 9950 ? "%.1fk" : "%.0fk", count / 1000.0);
}

// Heights by the logarithm, because p's outermost bins hold nearly all.
void DrawBars(Sheet* sheet, const Axes& axes, const std::array<Bin, 10>& bins) {
  int most = 1;
  for (const Bin& bin : bins) most = std::max(most, bin.count);
  const int bottom = axes.top + kPlot + kBelow + 18 + kBars;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const int x = axes.X(static_cast<double>(i) / 10), width = kPlot / 10;
    const int height =
        static_cast<int>(std::lround(kBars * std::log1p(bins[i].count) / std::log1p(most)));
    sheet->Fill(x + 2, bottom - height, width - 4, height, kRule);
    sheet->Centered(x + width / 2, bottom - height - 15, Short(bins[i].count), kCountStyle);
  }
  sheet->Line(axes.X(0), bottom, axes.X(1), bottom, kFaint, 1);
}

void DrawPanel(Sheet* sheet, int x, int y, const model::Judgements& judgements) {
  const Axes axes{x + kLeft, y};
  const std::array<Bin, 10> bins = Reliability(judgements);
  DrawAxes(sheet, axes);
  DrawCurve(sheet, axes, bins);
  DrawBars(sheet, axes, bins);
  sheet->TextUpwards(x + 4, y + kPlot / 2, "observed frequency", kTickStyle);
  sheet->Centered(axes.X(0.5), y + kPlot + 18, "predicted probability", kTickStyle);
  const int below = y + kPlot + kBelow + 18 + kBars + 4;
  const double base = model::BaseRate(judgements);
  sheet->Centered(axes.X(0.5), below,
                  "Brier " + Number("%.3f", model::BrierScore(judgements)) +
                      Number(" (base rate %.2f", base) + Number(": %.3f)", base * (1 - base)),
                  {0.4, kInk, false});
  sheet->Centered(axes.X(0.5), below + 18,
                  std::to_string(judgements.size()) + " judgements, calibration error " +
                      Number("%.3f", CalibrationError(bins)),
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
  Sheet sheet(2 * kMargin + kName + static_cast<int>(std::size(kHeads)) * kPanel);
  int y = DrawHeading(&sheet, "Calibration of V, Q, p and f: " + task);
  int x = kMargin + kName;
  for (const Head& head : kHeads) {
    sheet.Centered(x + kLeft + kPlot / 2, y, std::string(head.name) + ": " + head.what, kBodyStyle);
    x += kPanel;
  }
  y += Sheet::LineHeight(kBodyStyle) + 6;
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

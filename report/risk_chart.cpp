#include "report/risk_chart.h"

#include <algorithm>
#include <cmath>

#include "base/number_format.h"

namespace prospect::report {
namespace {

// Pixels.
constexpr int kWidth = 360, kHeight = 200, kLeft = 48, kBottom = 40, kTop = 10, kRight = 14;
constexpr double kLeastCoverage = 0.05;  // left of it a point stands on a handful of scenes

// Where (coverage, risk) lies in the chart.
struct Axes {
  double most_risk;
  double X(double coverage) const { return kLeft + coverage * (kWidth - kLeft - kRight); }
  double Y(double risk) const {
    return kHeight - kBottom - std::min(risk / most_risk, 1.0) * (kHeight - kBottom - kTop);
  }
};

Axes AxesFor(const std::vector<model::ThresholdEffect>& curve) {
  double most = 0.1;
  for (const auto& effect : curve) {
    if (effect.coverage >= kLeastCoverage) most = std::max(most, effect.risk);
  }
  return {std::ceil(most * 10) / 10};
}

std::string Line(double x0, double y0, double x1, double y1, const char* color) {
  return "<path d=\"M" + base::Number("%.1f", x0) + base::Number(" %.1f", y0) +
         base::Number(" L%.1f", x1) + base::Number(" %.1f", y1) + "\" stroke=\"" + color +
         "\"></path>\n";
}

std::string Words(double x, double y, const char* anchor, const std::string& text) {
  return "<text x=\"" + base::Number("%.1f", x) + "\" y=\"" + base::Number("%.1f", y) +
         "\" text-anchor=\"" + anchor + "\" font-size=\"11\" fill=\"var(--faint)\">" + text +
         "</text>\n";
}

std::string Grid(const Axes& axes) {
  std::string svg;
  for (int i = 0; i <= 4; ++i) {
    const double x = axes.X(i / 4.0);
    svg += Line(x, kTop, x, kHeight - kBottom, "var(--rule)");
    svg += Words(x, kHeight - kBottom + 14, "middle", base::Number("%.0f %%", 25.0 * i));
  }
  const int steps = std::max(1, static_cast<int>(std::lround(axes.most_risk * 10)));
  for (int i = 0; i <= steps; ++i) {
    const double y = axes.Y(i / 10.0);
    svg += Line(kLeft, y, kWidth - kRight, y, "var(--rule)");
    svg += Words(kLeft - 6, y + 4, "end", base::Number("%.0f %%", 10.0 * i));
  }
  return svg +
         Words((kLeft + kWidth - kRight) / 2.0, kHeight - 6, "middle", "attempted of all scenes") +
         "<text transform=\"translate(11," +
         base::Number("%.0f", (kTop + kHeight - kBottom) / 2.0) +
         ") rotate(-90)\" text-anchor=\"middle\" font-size=\"11\" fill=\"var(--faint)\">failed of "
         "these</text>\n";
}

std::string Steps(const Axes& axes, const std::vector<model::ThresholdEffect>& curve) {
  std::string points;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const std::string x = base::Number("%.1f,", axes.X(curve[i].coverage));
    if (i > 0) points += x + base::Number("%.1f ", axes.Y(curve[i - 1].risk));
    points += x + base::Number("%.1f ", axes.Y(curve[i].risk));
  }
  return "<polyline fill=\"none\" stroke=\"var(--bar)\" stroke-width=\"2\" points=\"" + points +
         "\"></polyline>\n";
}

// The most lenient point of the curve that the threshold still lets through.
std::string Mark(const Axes& axes, const std::vector<model::ThresholdEffect>& curve,
                 double threshold) {
  const model::ThresholdEffect* at = nullptr;
  for (const auto& effect : curve) {
    if (effect.threshold >= threshold) at = &effect;
  }
  if (at == nullptr) return "";
  return "<circle cx=\"" + base::Number("%.1f", axes.X(at->coverage)) + "\" cy=\"" +
         base::Number("%.1f", axes.Y(at->risk)) + "\" r=\"5\" fill=\"var(--bad)\"></circle>\n";
}

}  // namespace

std::string RiskChart(const agent::RefusalTerms& terms, double threshold) {
  if (terms.curve.size() < 2) return "";
  const Axes axes = AxesFor(terms.curve);
  return "<svg width=\"" + std::to_string(kWidth) + "\" height=\"" + std::to_string(kHeight) +
         "\" role=\"img\" aria-label=\"share that fails against share that is attempted\">\n" +
         Grid(axes) + Steps(axes, terms.curve) + Mark(axes, terms.curve, threshold) + "</svg>\n";
}

}  // namespace prospect::report

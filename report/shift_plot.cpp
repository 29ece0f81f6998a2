#include "report/shift_plot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/number_format.h"
#include "report/page.h"
#include "report/plot.h"
#include "report/png.h"

namespace prospect::report {
namespace {

using nlohmann::json;

constexpr int kBar = 34, kStep = 44, kHigh = 220, kLeft = 46, kBelow = 62;

struct Part {
  const char* key;
  const char* word;
  Color color;
};
// From below upwards.
const Part kParts[] = {{"solved", "solved", kGood},
                       {"failed", "attempted and failed", kBad},
                       {"refused", "refused", kRule}};

// The points of one panel: without a shift, then the factor's.
std::vector<json> PanelPoints(const json& summary, const std::string& factor) {
  std::vector<json> points;
  for (const json& point : summary.at("points")) {
    if (point.at("strength") == 0 || point.at("factor") == factor) points.push_back(point);
  }
  return points;
}

void DrawBar(Canvas* canvas, int x, int y, const json& point) {
  const double scenes = std::max(1.0, point.at("scenes").get<double>());
  double sum = 0;
  for (const Part& part : kParts) {
    const int low = static_cast<int>(std::lround(kHigh * sum / scenes));
    sum += point.at(part.key).get<double>();
    const int high = static_cast<int>(std::lround(kHigh * sum / scenes));
    canvas->Fill(x, y + kHigh - high, kBar, high - low, part.color);
  }
  const bool shifted = point.at("strength") != 0;
  const int middle = x + kBar / 2;
  canvas->Centered(middle, y + kHigh + 4,
                   shifted ? std::to_string(point.at("strength").get<int>()) : "-", kTickStyle);
  if (shifted)
    canvas->Centered(middle, y + kHigh + 20, base::Number("%g", point.at("amount").get<double>()),
                     kTickStyle);
}

void DrawPanel(Canvas* canvas, int x, int y, const std::string& factor, const json& summary) {
  const std::vector<json> points = PanelPoints(summary, factor);
  const int width = kStep * static_cast<int>(points.size());
  canvas->Text(x, y, factor, kHeadStyle);
  const int top = y + Canvas::LineHeight(kHeadStyle) + 6;
  Plot plot(canvas, x, top, width, kHigh, {}, {0, 100, Axis::Scale::kLinear});
  for (int percent = 0; percent <= 100; percent += 25)
    plot.TickY(percent, std::to_string(percent) + " %");
  for (std::size_t i = 0; i < points.size(); ++i)
    DrawBar(canvas, x + kStep * static_cast<int>(i) + (kStep - kBar) / 2, top, points[i]);
  canvas->Centered(x + width / 2, top + kHigh + 38, "strength, and what it is", kTickStyle);
}

int DrawLegend(Canvas* canvas, int x, int y) {
  for (const Part& part : kParts) {
    canvas->Fill(x, y + 3, 14, 12, part.color);
    canvas->Text(x + 20, y, part.word, kBodyStyle);
    x += 50 + Canvas::TextWidth(part.word, kBodyStyle);
  }
  return y + Canvas::LineHeight(kBodyStyle) + 8;
}

std::vector<std::string> FactorsOf(const json& summary) {
  std::vector<std::string> factors;
  for (const json& point : summary.at("points")) {
    const std::string factor = point.at("factor");
    if (!factor.empty() && (factors.empty() || factors.back() != factor)) factors.push_back(factor);
  }
  return factors;
}

// Room for the panel with the most bars.
int PanelWidth(const json& summary, const std::vector<std::string>& factors) {
  std::size_t most = 1;
  for (const std::string& factor : factors)
    most = std::max(most, PanelPoints(summary, factor).size());
  return kLeft + kStep * static_cast<int>(most) + 26;
}

std::string Caption(const json& summary) {
  return "What becomes of " + std::to_string(summary.at("scenes").get<int>()) +
         " scenes when the planner looks once, under a shift of what its camera shows, and its "
         "plan is carried out as it is. The leftmost bar of each panel is without a shift. The "
         "numbers below the strengths: scale of the light, degrees that the camera is turned, "
         "degrees that hues are turned, standard deviation of the sensor noise.";
}

}  // namespace

void WriteShiftPlot(const std::string& path, const json& summary, const std::string& title) {
  const std::vector<std::string> factors = FactorsOf(summary);
  const int panel = PanelWidth(summary, factors);
  Canvas canvas(std::max(kLeastWidth, 2 * kMargin + panel * static_cast<int>(factors.size())));
  int y = DrawHeading(&canvas, title);
  y = DrawLegend(&canvas, kMargin, y);
  int x = kMargin + kLeft;
  for (const std::string& factor : factors) {
    DrawPanel(&canvas, x, y, factor, summary);
    x += panel;
  }
  WritePng(path, Captioned(&canvas, y + kHigh + kBelow + 24, Caption(summary)));
}

}  // namespace prospect::report

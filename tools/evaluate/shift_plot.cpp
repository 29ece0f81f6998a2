#include "tools/evaluate/shift_plot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/shift.h"
#include "tools/figures/page.h"

namespace prospect::tools {
namespace {

using figures::Sheet;
using nlohmann::json;

constexpr int kBar = 34, kStep = 44, kHigh = 220, kLeft = 46, kBelow = 62;
constexpr figures::Style kTick{0.38, figures::kFaint, false};

struct Part {
  const char* key;
  const char* word;
  figures::Color color;
};
// From below upwards.
const Part kParts[] = {{"solved", "solved", figures::kGood},
                       {"failed", "attempted and failed", figures::kBad},
                       {"refused", "refused", figures::kRule}};

// The points of one panel: without a shift, then the factor's.
std::vector<json> PanelPoints(const json& summary, const std::string& factor) {
  std::vector<json> points;
  for (const json& point : summary.at("points")) {
    if (point.at("strength") == 0 || point.at("factor") == factor) points.push_back(point);
  }
  return points;
}

void DrawScale(Sheet* sheet, int x, int y, int width) {
  for (int percent = 0; percent <= 100; percent += 25) {
    const int at = y + kHigh - percent * kHigh / 100;
    sheet->Line(x, at, x + width, at, figures::kPale, 1);
    const std::string number = std::to_string(percent) + " %";
    sheet->Text(x - 6 - Sheet::TextWidth(number, kTick), at - 7, number, kTick);
  }
}

void DrawBar(Sheet* sheet, int x, int y, const json& point) {
  const double scenes = std::max(1.0, point.at("scenes").get<double>());
  double sum = 0;
  for (const Part& part : kParts) {
    const int low = static_cast<int>(std::lround(kHigh * sum / scenes));
    sum += point.at(part.key).get<double>();
    const int high = static_cast<int>(std::lround(kHigh * sum / scenes));
    sheet->Fill(x, y + kHigh - high, kBar, high - low, part.color);
  }
  const bool shifted = point.at("strength") != 0;
  const int middle = x + kBar / 2;
  sheet->Centered(middle, y + kHigh + 4,
                  shifted ? std::to_string(point.at("strength").get<int>()) : "-", kTick);
  if (shifted)
    sheet->Centered(middle, y + kHigh + 20, figures::Number("%g", point.at("amount").get<double>()),
                    kTick);
}

void DrawPanel(Sheet* sheet, int x, int y, const std::string& factor, const json& summary) {
  const std::vector<json> points = PanelPoints(summary, factor);
  const int width = kStep * static_cast<int>(points.size());
  sheet->Text(x, y, factor, figures::kHeadStyle);
  const int top = y + Sheet::LineHeight(figures::kHeadStyle) + 6;
  DrawScale(sheet, x, top, width);
  for (std::size_t i = 0; i < points.size(); ++i)
    DrawBar(sheet, x + kStep * static_cast<int>(i) + (kStep - kBar) / 2, top, points[i]);
  sheet->Centered(x + width / 2, top + kHigh + 38, "strength, and what it is", kTick);
}

int DrawLegend(Sheet* sheet, int x, int y) {
  for (const Part& part : kParts) {
    sheet->Fill(x, y + 3, 14, 12, part.color);
    sheet->Text(x + 20, y, part.word, figures::kBodyStyle);
    x += 50 + Sheet::TextWidth(part.word, figures::kBodyStyle);
  }
  return y + Sheet::LineHeight(figures::kBodyStyle) + 8;
}

std::vector<std::string> FactorsOf(const json& summary) {
  std::vector<std::string> factors;
  for (const json& point : summary.at("points")) {
    const std::string factor = point.at("factor");
    if (!factor.empty() && (factors.empty() || factors.back() != factor)) factors.push_back(factor);
  }
  return factors;
}

std::string Caption(const json& summary) {
  return "What becomes of " + std::to_string(summary.at("scenes").get<int>()) +
         " scenes when the planner looks once, under a shift of what its camera shows, and its "
         "plan "
         "is carried out as it is. The leftmost bar of each panel is without a shift. The numbers "
         "below the strengths: scale of the light, degrees that the camera is turned, degrees that "
         "hues are turned, standard deviation of the sensor noise.";
}

}  // namespace

bool WriteShiftPlot(const std::string& path, const json& summary, const std::string& title) {
  const std::vector<std::string> factors = FactorsOf(summary);
  const int panel = kLeft + kStep * (1 + sim::kShiftStrengths) + 26;
  Sheet sheet(std::max(figures::kLeastWidth,
                       2 * figures::kMargin + panel * static_cast<int>(factors.size())));
  int y = figures::DrawHeading(&sheet, title);
  y = DrawLegend(&sheet, figures::kMargin, y);
  int x = figures::kMargin + kLeft;
  for (const std::string& factor : factors) {
    DrawPanel(&sheet, x, y, factor, summary);
    x += panel;
  }
  const auto slash = path.find_last_of('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash);
  const std::string file = slash == std::string::npos ? path : path.substr(slash + 1);
  figures::WritePage(folder,
                     figures::Finish(&sheet, y + kHigh + kBelow + 24, file, Caption(summary)));
  return true;
}

}  // namespace prospect::tools

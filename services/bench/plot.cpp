#include "services/bench/plot.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/atomic_file.h"

namespace prospect::services {
namespace {

using nlohmann::json;

constexpr int kWidth = 760, kHeight = 520, kLeft = 80, kRight = 40, kTop = 60, kBottom = 60;
const cv::Scalar kInk(40, 40, 40), kPale(215, 215, 215), kMeasured(180, 90, 20);

// Both axes by doubling: where (workers, rollouts/s) lies on the sheet.
struct Axes {
  double x0, x1, y0, y1;  // logarithms to base 2
  cv::Point At(double workers, double rate) const {
    const double x = (std::log2(workers) - x0) / std::max(1e-9, x1 - x0);
    const double y = (std::log2(rate) - y0) / std::max(1e-9, y1 - y0);
    return {kLeft + static_cast<int>(x * (kWidth - kLeft - kRight)),
            kHeight - kBottom - static_cast<int>(y * (kHeight - kTop - kBottom))};
  }
};

void Write(cv::Mat* sheet, const std::string& text, cv::Point at, double size = 0.42) {
  cv::putText(*sheet, text, at, cv::FONT_HERSHEY_SIMPLEX, size, kInk, 1, cv::LINE_AA);
}

std::string Number(double x, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

Axes AxesFor(const json& rows) {
  const auto& first = rows.front();
  const auto& last = rows.back();
  const double x0 = std::log2(first.at("workers").get<double>());
  const double x1 = std::log2(last.at("workers").get<double>());
  const double low = std::log2(std::max(1e-3, first.at("rollouts_per_s").get<double>()));
  return {x0, x1, std::floor(low), std::ceil(low + std::max(1.0, x1 - x0))};
}

void DrawGrid(const Axes& axes, const json& rows, cv::Mat* sheet) {
  for (double y = axes.y0; y <= axes.y1; ++y) {
    const cv::Point left = axes.At(std::exp2(axes.x0), std::exp2(y));
    cv::line(*sheet, left, {kWidth - kRight, left.y}, kPale);
    Write(sheet, Number(std::exp2(y), "%6.0f"), {12, left.y + 4});
  }
  for (const json& row : rows) {
    const cv::Point bottom = axes.At(row.at("workers").get<double>(), std::exp2(axes.y0));
    cv::line(*sheet, bottom, {bottom.x, kTop}, kPale);
    Write(sheet, Number(row.at("workers").get<double>(), "%.0f"), {bottom.x - 6, bottom.y + 20});
  }
}

void DrawCurves(const Axes& axes, const json& rows, cv::Mat* sheet) {
  const double base =
      rows.front().at("rollouts_per_s").get<double>() / rows.front().at("workers").get<double>();
  cv::Point before, ideal_before;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double workers = rows[i].at("workers").get<double>();
    const cv::Point at =
        axes.At(workers, std::max(1e-3, rows[i].at("rollouts_per_s").get<double>()));
    const cv::Point ideal = axes.At(workers, std::max(1e-3, base * workers));
    if (i > 0) {
      cv::line(*sheet, ideal_before, ideal, {170, 170, 170}, 1, cv::LINE_AA);
      cv::line(*sheet, before, at, kMeasured, 2, cv::LINE_AA);
    }
    cv::circle(*sheet, at, 4, kMeasured, cv::FILLED, cv::LINE_AA);
    Write(sheet, "batch " + Number(rows[i].at("mean_batch").get<double>(), "%.1f"),
          {std::min(at.x + 8, kWidth - 100), at.y + 18}, 0.36);
    before = at;
    ideal_before = ideal;
  }
}

}  // namespace

void WritePlot(const std::string& path, const json& rows, const std::string& title) {
  cv::Mat sheet(kHeight, kWidth, CV_8UC3, cv::Scalar(255, 255, 255));
  const Axes axes = AxesFor(rows);
  DrawGrid(axes, rows, &sheet);
  DrawCurves(axes, rows, &sheet);
  Write(&sheet, title, {kLeft, 24}, 0.48);
  Write(&sheet, "rollouts a second; grey: in proportion to the workers", {kLeft, 44}, 0.38);
  Write(&sheet, "planner workers", {kWidth / 2 - 50, kHeight - 14});
  std::vector<unsigned char> png;
  cv::imencode(".png", sheet, png);
  base::WriteFile(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace prospect::services

#include "services/executive/explanation_pictures.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "agent/explanation_text.h"
#include "services/executive/canvas.h"

namespace prospect::services {

using namespace agent;

namespace {

constexpr int kMargin = 20, kGap = 14, kSide = 160, kLeastWidth = 760;

// Blue, green, red.
const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kFaint(120, 120, 120);
const cv::Scalar kFrame(205, 205, 205);
const cv::Scalar kBad(50, 50, 200);

const Canvas::Style kTitle{0.6, kInk, false};
const Canvas::Style kName{0.45, kInk, false};
const Canvas::Style kSmall{0.42, kFaint, false};

std::string Number(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string Figures(const ExplainedStep& step) {
  if (!step.imagined) {
    return step.prior < 0 ? "not imagined" : Number("not imagined: p %.3f", step.prior);
  }
  return Number("V %.2f", step.value) + Number("   f %.2f", step.done);
}

int DrawStep(Canvas& canvas, const ExplainedPlan& plan, std::size_t index, int x, int y) {
  const ExplainedStep& step = plan.steps[index];
  const bool lost = static_cast<int>(index) + 1 == plan.given_up;
  canvas.Image(x, y, kSide, step.picture, lost ? kBad : kFrame);
  const std::string name = std::to_string(index + 1) + ". " + step.name;
  const int below =
      canvas.Paragraph(x, y + kSide + 6, kSide, name, {kName.size, lost ? kBad : kInk, false});
  return canvas.Paragraph(x, below, kSide, Figures(step), kSmall);
}

void WriteStrip(const ExplainedPlan& plan, const std::string& title, const std::string& words,
                const std::string& path) {
  const int per_row =
      Canvas::PerRow(static_cast<int>(plan.steps.size()), kSide + kGap, 2 * kMargin);
  Canvas canvas(std::max(kLeastWidth, 2 * kMargin + per_row * (kSide + kGap)));
  const int width = canvas.width() - 2 * kMargin;
  int y = canvas.Paragraph(kMargin, kMargin, width, title, kTitle);
  y = canvas.Paragraph(kMargin, y, width, words, kName) + 8;
  int bottom = y;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const int column = static_cast<int>(i) % per_row;
    if (i > 0 && column == 0) y = bottom + kGap;
    const int x = kMargin + column * (kSide + kGap);
    bottom = std::max(bottom, DrawStep(canvas, plan, i, x, y));
  }
  canvas.Write(path, bottom + kMargin);
}

std::string AlternativeFile(const std::string& folder, int number) {
  return folder + "/alternative-" + std::to_string(number) + ".png";
}

void RemoveFormer(const std::string& folder) {
  std::error_code ignored;
  for (const char* name : {"/chosen.png", "/what-if.png"})
    std::filesystem::remove(folder + name, ignored);
  for (int i = 1; i <= kAlternatives; ++i)
    std::filesystem::remove(AlternativeFile(folder, i), ignored);
}

}  // namespace

std::string PngOf(const Picture& picture) {
  const cv::Mat rgb(picture.height, picture.width, CV_8UC3,
                    const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  std::vector<unsigned char> png;
  cv::imencode(".png", bgr, png);
  return {png.begin(), png.end()};
}

void WriteExplanationPictures(const Explanation& explanation, const std::string& folder) {
  RemoveFormer(folder);
  const std::string verdict = Headline(explanation) + ". " + ScoreSentence(explanation);
  if (!explanation.chosen.steps.empty())
    WriteStrip(explanation.chosen, verdict, explanation.chosen.why, folder + "/chosen.png");
  int number = 0;
  for (const auto& plan : explanation.alternatives) {
    ++number;
    WriteStrip(plan, "Alternative " + std::to_string(number), plan.why,
               AlternativeFile(folder, number));
  }
  if (!explanation.what_if) return;
  std::string words;
  for (const auto& finding : explanation.what_if->findings) words += finding + " ";
  WriteStrip(explanation.what_if->plan, "What if", words, folder + "/what-if.png");
}

}  // namespace prospect::services

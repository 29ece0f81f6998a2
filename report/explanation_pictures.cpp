#include "report/explanation_pictures.h"

#include <algorithm>
#include <filesystem>

#include "agent/explanation_text.h"
#include "base/number_format.h"
#include "report/canvas.h"
#include "report/page.h"
#include "report/png.h"

namespace prospect::report {

using agent::ExplainedPlan;
using agent::ExplainedStep;
using agent::Explanation;

namespace {

constexpr int kGap = 14, kPicture = 160;  // pixels

constexpr Style kTitle{0.6, kInk, false};

std::string Figures(const ExplainedStep& step) {
  if (!step.imagined) {
    return step.prior < 0 ? "not imagined" : base::Number("not imagined: p %.3f", step.prior);
  }
  return base::Number("V %.2f", step.value) + base::Number("   f %.2f", step.done);
}

int DrawStep(Canvas& canvas, const ExplainedPlan& plan, std::size_t index, int x, int y) {
  const ExplainedStep& step = plan.steps[index];
  const bool lost = static_cast<int>(index) + 1 == plan.given_up;
  canvas.Framed(x, y, kPicture, step.picture, lost ? kBad : kRule);
  const std::string name = std::to_string(index + 1) + ". " + step.name;
  const int below = canvas.Paragraph(x, y + kPicture + 6, kPicture, name,
                                     {kBodyStyle.size, lost ? kBad : kInk, false});
  return canvas.Paragraph(x, below, kPicture, Figures(step), kSmallStyle);
}

void WriteStrip(const ExplainedPlan& plan, const std::string& title, const std::string& words,
                const std::string& path) {
  const int per_row =
      Canvas::PerRow(static_cast<int>(plan.steps.size()), kPicture + kGap, 2 * kMargin);
  Canvas canvas(std::max(kLeastWidth, 2 * kMargin + per_row * (kPicture + kGap)));
  const int width = canvas.width() - 2 * kMargin;
  int y = canvas.Paragraph(kMargin, kMargin, width, title, kTitle);
  y = canvas.Paragraph(kMargin, y, width, words, kBodyStyle) + 8;
  int bottom = y;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const int column = static_cast<int>(i) % per_row;
    if (i > 0 && column == 0) y = bottom + kGap;
    const int x = kMargin + column * (kPicture + kGap);
    bottom = std::max(bottom, DrawStep(canvas, plan, i, x, y));
  }
  WritePng(path, canvas.Cut(bottom + kMargin));
}

std::string AlternativeFile(const std::string& folder, int number) {
  return folder + "/alternative-" + std::to_string(number) + ".png";
}

void RemoveFormer(const std::string& folder) {
  std::error_code ignored;
  for (const char* name : {"/chosen.png", "/what-if.png"})
    std::filesystem::remove(folder + name, ignored);
  for (int i = 1; i <= agent::kAlternatives; ++i)
    std::filesystem::remove(AlternativeFile(folder, i), ignored);
}

}  // namespace

void WriteExplanationPictures(const Explanation& explanation, const std::string& folder) {
  RemoveFormer(folder);
  const std::string verdict =
      agent::Headline(explanation) + ". " + agent::ScoreSentence(explanation);
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

}  // namespace prospect::report

#include "report/risk_chart.h"

#include <gtest/gtest.h>

namespace prospect::report {
namespace {

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// 30 scenes that score 0.2 to 0.229, a third solved, and 50 that score 0.8 to 0.849.
agent::RefusalTerms Terms() {
  model::CalibrationSample sample;
  for (int i = 0; i < 80; ++i) {
    const bool sure = i >= 30;
    sample.scenes.push_back(
        {(sure ? 0.77 : 0.2) + 0.001 * i, model::SceneClass::kSolvable,
         sure || i % 3 == 0 ? model::SceneEnding::kSolved : model::SceneEnding::kFailed});
  }
  return agent::TermsOf(sample, "paper", {}, false);
}

TEST(RiskChart, ShowsTheCurveAndTheThresholdOnIt) {
  const std::string chart = RiskChart(Terms(), 0.5);
  EXPECT_EQ(chart.rfind("<svg ", 0), 0u);
  EXPECT_TRUE(Holds(chart, "<polyline "));
  EXPECT_TRUE(Holds(chart, "<circle ")) << "the threshold";
  EXPECT_FALSE(Holds(RiskChart(Terms(), 0.9), "<circle ")) << "above every score";
  // 50 of 80 are attempted at 0.5, at x = 48 + 0.625 * 298.
  EXPECT_TRUE(Holds(chart, "<circle cx=\"234.2\"")) << chart;
  EXPECT_EQ(RiskChart({}, 0.5), "");
}

}  // namespace
}  // namespace prospect::report

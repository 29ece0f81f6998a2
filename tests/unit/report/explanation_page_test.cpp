#include "report/explanation_page.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <regex>
#include <set>

#include "report/explanation_pictures.h"
#include "report/html.h"

namespace prospect::report {
namespace {

using namespace agent;

// Tags that are not closed in their order, one a line; empty when the page is well formed.
std::string TagDefects(const std::string& page) {
  static const std::set<std::string> kVoid{"meta", "img", "br", "wbr"};
  static const std::regex kTag(R"(<(/?)([a-z0-9]+)((?:\s+[a-z-]+="[^"<>]*")*)\s*>)");
  std::vector<std::string> open;
  std::string defects;
  const auto begin = page.find("<html");
  for (auto at = begin; at != std::string::npos && at < page.size();) {
    at = page.find('<', at);
    if (at == std::string::npos) break;
    // A data: URI is long; the pattern looks at everything but it.
    const auto end = page.find('>', at);
    std::string tag = page.substr(at, end == std::string::npos ? 40 : end - at + 1);
    tag = std::regex_replace(tag, std::regex("base64,[A-Za-z0-9+/=]*"), "base64,");
    std::smatch match;
    if (!std::regex_match(tag, match, kTag)) {
      defects += "no tag: " + tag.substr(0, 80) + "\n";
    } else if (match[1] == "/") {
      if (open.empty() || open.back() != match[2]) defects += "closed too early: " + tag + "\n";
      if (!open.empty()) open.pop_back();
    } else if (!kVoid.contains(match[2])) {
      open.push_back(match[2]);
    }
    at = end == std::string::npos ? end : end + 1;
  }
  for (const auto& tag : open) defects += "never closed: " + tag + "\n";
  return defects;
}

std::size_t Count(const std::string& page, const std::string& what) {
  std::size_t count = 0;
  for (auto at = page.find(what); at != std::string::npos; at = page.find(what, at + 1)) ++count;
  return count;
}

sim::Image Grey() {
  sim::Image picture;
  picture.width = picture.height = 2;
  picture.rgb.assign(12, 128);
  return picture;
}

ExplainedStep Step(const std::string& name, bool picture = true) {
  ExplainedStep step;
  step.name = name;
  step.value = 0.71;
  step.done = 0.96;
  if (picture) step.picture = Grey();
  return step;
}

ExplainedPlan PlanOf(std::vector<ExplainedStep> steps, const std::string& why) {
  ExplainedPlan plan;
  plan.steps = std::move(steps);
  plan.score = 0.5;
  plan.why = why;
  return plan;
}

Explanation Acting() {
  Explanation explanation;
  explanation.task = "stacking";
  explanation.seed = 2000100;
  explanation.weights = "391aa9e00c310584";
  explanation.engine = "torch";
  explanation.ended_by = "samples";
  explanation.act = true;
  explanation.score = 0.66;
  explanation.parameters.refusal_threshold = 0.21;
  explanation.seen = Grey();
  explanation.chosen = PlanOf({Step("align(green)"), Step("grasp(green)")}, "");
  explanation.alternatives = {
      PlanOf({Step("align(red)")}, "V fell from 0.71 to 0.12 at step 1, align(red)")};
  return explanation;
}

TEST(ExplanationPageTest, IsWellFormedAndRefersToNothingOutside) {
  const std::string page = ExplanationPage(Acting());
  EXPECT_EQ(TagDefects(page), "");
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(page.find("url("), std::string::npos);
  EXPECT_EQ(page.find("href"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<link"), std::string::npos);
  EXPECT_EQ(Count(page, "src="), Count(page, "src=\"data:image/png;base64,"));
}

TEST(ExplanationPageTest, TheCheckerSeesWhatIsWrong) {
  EXPECT_NE(TagDefects("<html><p>a</html>"), "");
  EXPECT_NE(TagDefects("<html><p>a < b</p></html>"), "");
  EXPECT_NE(TagDefects("<html><p title=x>a</p></html>"), "");
  EXPECT_EQ(TagDefects("<html><p title=\"x\">a<br></p></html>"), "");
}

TEST(ExplanationPageTest, TellsVerdictPlansReasonsAndTheSearch) {
  const std::string page = ExplanationPage(Acting());
  EXPECT_NE(page.find("<h1 class=\"act\">Act: begin with align(green)</h1>"), std::string::npos);
  EXPECT_NE(page.find("Score 0.66; plans below 0.21 are refused."), std::string::npos);
  EXPECT_NE(page.find("V&nbsp;0.71 &ensp;f&nbsp;0.96"), std::string::npos);
  EXPECT_NE(page.find("V fell from 0.71 to 0.12 at step 1, align(red)"), std::string::npos);
  EXPECT_NE(page.find("391aa9e00c310584 (torch)"), std::string::npos);
  EXPECT_EQ(page.find("What if"), std::string::npos);
}

TEST(ExplanationPageTest, TellsWhatCalibrationScenesSay) {
  EXPECT_EQ(ExplanationPage(Acting()).find("When to refuse"), std::string::npos);
  Explanation explanation = Acting();
  model::CalibrationSample sample;
  for (int i = 0; i < 40; ++i)
    sample.scenes.push_back({0.02 * i, model::SceneClass::kSolvable,
                             i < 10 ? model::SceneEnding::kFailed : model::SceneEnding::kSolved});
  explanation.confidence = ConfidenceOf(sample, 0.66, 0);
  explanation.terms = TermsOf(sample, "paper", {}, false);
  explanation.terms->promises = {"Refuses at most <5 %."};
  const std::string page = ExplanationPage(explanation);
  EXPECT_EQ(TagDefects(page), "");
  EXPECT_NE(page.find("Succeeds in about 75 %: of 40 calibration scenes"), std::string::npos);
  EXPECT_NE(page.find("Refuses at most &lt;5 %."), std::string::npos);
  EXPECT_NE(page.find("When to refuse"), std::string::npos);
  EXPECT_NE(page.find("<polyline "), std::string::npos);
}

TEST(ExplanationPageTest, EveryPictureHasItsWords) {
  const std::string page = ExplanationPage(Acting());
  EXPECT_EQ(Count(page, "<img "), 4u);
  EXPECT_NE(page.find("alt=\"imagined picture after step 2, grasp(green)\""), std::string::npos);
  EXPECT_NE(page.find("alt=\"what the camera sees now\""), std::string::npos);
  EXPECT_EQ(Count(page, "alt=\"\""), 0u);
}

TEST(ExplanationPageTest, NamesAreEscaped) {
  Explanation explanation = Acting();
  const std::string name = "<img src=x onerror=\"alert('1')\">&";
  explanation.task = explanation.chosen.steps[0].name = explanation.ended_by = name;
  explanation.weights = explanation.engine = name;
  explanation.alternatives[0].steps[0].name = explanation.alternatives[0].why = name;
  explanation.ruled_out = explanation.untried = {name};
  explanation.what_if = WhatIf{PlanOf({Step(name)}, ""), 0, {name}};
  const std::string page = ExplanationPage(explanation);
  EXPECT_EQ(TagDefects(page), "");
  EXPECT_EQ(page.find("<img src=x"), std::string::npos);
  EXPECT_EQ(Escaped("a<b>&\"'\n"), "a&lt;b&gt;&amp;&quot;&#39; ");
  explanation.act = false;
  explanation.reason = name;
  EXPECT_EQ(TagDefects(ExplanationPage(explanation)), "");
}

TEST(ExplanationPageTest, ARefusalThatImaginedNothing) {
  Explanation explanation;
  explanation.task = "stacking";
  explanation.reason = "every future fails";
  const std::string page = ExplanationPage(explanation);
  EXPECT_EQ(TagDefects(page), "");
  EXPECT_NE(page.find("<h1 class=\"refuse\">Refuse</h1>"), std::string::npos);
  EXPECT_NE(page.find("Every future fails."), std::string::npos);
  EXPECT_EQ(page.find("The chosen plan"), std::string::npos);
  EXPECT_EQ(page.find("<img "), std::string::npos);
}

TEST(ExplanationPageTest, ARefusalWithoutASearchSaysSo) {
  Explanation explanation;
  explanation.goal = {"on(red,purple)"};
  explanation.reason = "there is no purple";
  const std::string page = ExplanationPage(explanation);
  EXPECT_EQ(TagDefects(page), "");
  EXPECT_NE(page.find("Goal: on(red,purple)."), std::string::npos);
  EXPECT_NE(page.find("Nothing was searched"), std::string::npos);
  EXPECT_EQ(page.find("Rollouts"), std::string::npos);
  EXPECT_NE(ExplanationPage(Acting()).find("Rollouts"), std::string::npos);
}

TEST(ExplanationPageTest, WithoutAThresholdNoneIsNamed) {
  Explanation explanation = Acting();
  explanation.parameters.refusal_threshold = 0;
  EXPECT_NE(ExplanationPage(explanation).find("no threshold is set"), std::string::npos);
}

TEST(ExplanationPageTest, MarksTheStepAtWhichAPlanWasGivenUp) {
  Explanation explanation = Acting();
  EXPECT_EQ(ExplanationPage(explanation).find("<li class=\"lost\">"), std::string::npos);
  explanation.alternatives[0].given_up = 1;
  EXPECT_EQ(Count(ExplanationPage(explanation), "<li class=\"lost\">"), 1u);
}

TEST(ExplanationPageTest, WordsOnlyWhereNoPictureCame) {
  Explanation explanation = Acting();
  explanation.seen = sim::Image{};
  explanation.chosen = PlanOf({Step("a", false)}, "");
  explanation.alternatives.clear();
  const std::string page = ExplanationPage(explanation);
  EXPECT_EQ(TagDefects(page), "");
  EXPECT_EQ(page.find("<img "), std::string::npos);
  EXPECT_EQ(page.find("no picture"), std::string::npos);
  EXPECT_NE(page.find("1.&nbsp;a"), std::string::npos);
}

TEST(ExplanationPageTest, TellsWhetherThePictureIsKnown) {
  const model::Novelty foreign{0.002, 0.051, 0.02, 3.25, 1.2, 1.0, 1.3};
  Explanation explanation;
  explanation.reason = model::NoveltyRefusal(foreign);
  explanation.ended_by = "samples";
  EXPECT_EQ(Count(ExplanationPage(explanation), "known ones"), 0u);
  Familiarity familiarity;
  familiarity.novelty = foreign;
  familiarity.seen = familiarity.redrawn = Grey();
  explanation.familiarity = familiarity;
  const std::string page = ExplanationPage(explanation);
  EXPECT_NE(page.find("The picture is unlike known ones"), std::string::npos);
  EXPECT_NE(page.find("99 % of known pictures stay below 0.020"), std::string::npos);
  EXPECT_NE(page.find("Where the two differ"), std::string::npos);
  explanation.familiarity->novelty.p = 0.5;
  EXPECT_NE(ExplanationPage(explanation).find("The picture is like known ones (p 0.5)."),
            std::string::npos);
}

TEST(Html, Base64AsInTheStandardsTable) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64("\xff\xfe"), "//4=");
}

TEST(ExplanationPicturesTest, OneFileAPlanAndNoneOfAnEarlierOne) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("prospect_explanation_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  Explanation explanation = Acting();
  explanation.alternatives.push_back(explanation.alternatives[0]);
  explanation.what_if = WhatIf{explanation.chosen, 0, {"It is the chosen plan."}};
  WriteExplanationPictures(explanation, folder);
  for (const char* name : {"chosen.png", "alternative-1.png", "alternative-2.png", "what-if.png"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  WriteExplanationPictures(Acting(), folder);
  EXPECT_TRUE(std::filesystem::exists(folder / "alternative-1.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "alternative-2.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "what-if.png"));
  std::filesystem::remove_all(folder);
  EXPECT_THROW(WriteExplanationPictures(Acting(), folder), std::runtime_error);
}

}  // namespace
}  // namespace prospect::report

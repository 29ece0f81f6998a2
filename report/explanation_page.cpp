#include "report/explanation_page.h"

#include <algorithm>

#include "agent/explanation_text.h"
#include "base/number_format.h"
#include "base/text.h"
#include "report/difference_map.h"
#include "report/html.h"
#include "report/png.h"
#include "report/risk_chart.h"

namespace prospect::report {

using namespace agent;

namespace {

constexpr char kStyle[] = R"css(
:root { color-scheme: light dark; --ink: #222; --faint: #636363; --rule: #ddd; --paper: #fff;
  --act: #2b7a3f; --refuse: #b25600; --bad: #b3261e; --bar: #4a7fb5; --track: #e6e6e6; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e4e4; --faint: #a5a5a5; --rule: #3a3a3a; --paper: #191919;
  --act: #6cc283; --refuse: #f0a65a; --bad: #f28b82; --bar: #7ba9d8; --track: #333; } }
* { box-sizing: border-box; }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper); max-width: 78rem;
  margin: 0 auto; padding: 1.2rem; overflow-wrap: anywhere; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: .2rem 0 .4rem; }
h1.act { color: var(--act); }
h1.refuse { color: var(--refuse); }
h2 { font-size: 1.15rem; margin: 2rem 0 .3rem; padding-top: 1rem; border-top: 1px solid var(--rule); }
h3 { font-size: 1rem; margin: 1.4rem 0 .1rem; }
p { margin: .3rem 0; }
.faint { color: var(--faint); font-size: .9rem; }
.verdict { display: flex; flex-wrap: wrap; gap: .4rem 1.6rem; align-items: flex-start; }
.verdict figure { width: 12rem; max-width: 100%; }
.verdict div { flex: 1 1 20rem; }
.row { display: flex; flex-wrap: wrap; gap: .8rem; margin: .6rem 0; }
.row figure { width: 12rem; max-width: 100%; }
.steps { display: grid; grid-template-columns: repeat(auto-fill, minmax(6.6rem, 1fr)); gap: .8rem .6rem;
  list-style: none; margin: .6rem 0; padding: 0; }
.steps li { font-size: .85rem; line-height: 1.35; }
figure { margin: 0; }
img { display: block; width: 100%; height: auto; border-radius: 4px; border: 1px solid var(--rule); }
.lost img, .lost .none { border: 3px solid var(--bad); }
.lost b { color: var(--bad); }
.same { opacity: .55; }
.none { display: grid; place-items: center; aspect-ratio: 1; border: 1px dashed var(--faint); border-radius: 4px;
  color: var(--faint); text-align: center; padding: .3rem; }
.bar { display: block; height: 4px; background: var(--track); border-radius: 2px; margin: .15rem 0; }
.bar i { display: block; height: 4px; background: var(--bar); border-radius: 2px; }
b { font-weight: 600; }
table { border-collapse: collapse; font-size: .95rem; }
th { text-align: left; font-weight: normal; color: var(--faint); padding: .15rem 1.2rem .15rem 0; vertical-align: top; }
td { padding: .15rem 0; }
@media (max-width: 32rem) { body { padding: .8rem; } .steps { grid-template-columns: repeat(auto-fill, minmax(6rem, 1fr)); } }
)css";

std::string Paragraph(const std::string& text, const std::string& attributes = "") {
  return text.empty() ? "" : Element("p", attributes, Escaped(text)) + "\n";
}

// Empty when there is no picture.
std::string Image(const sim::Image& picture, const std::string& alt) {
  if (picture.empty()) return "";
  return "<img width=\"" + std::to_string(picture.width) + "\" height=\"" +
         std::to_string(picture.height) + "\" alt=\"" + Escaped(alt) +
         "\" src=\"data:image/png;base64," + Base64(EncodePng(picture)) + "\">";
}

std::string Bar(double value) {
  const double percent = 100 * std::clamp(value, 0.0, 1.0);
  return "<span class=\"bar\"><i style=\"width:" + base::Number("%.1f", percent) +
         "%\"></i></span>";
}

std::string Figures(const ExplainedStep& step) {
  if (step.imagined) {
    return Bar(step.value) + "V&nbsp;" + base::Number("%.2f", step.value) + " &ensp;f&nbsp;" +
           base::Number("%.2f", step.done);
  }
  return step.prior >= 0 ? "p&nbsp;" + base::Number("%.3f", step.prior) : "";
}

// A name such as align_over(yellow) in a narrow column breaks before its bracket.
std::string Breakable(const std::string& name) {
  std::string text = Escaped(name);
  const auto bracket = text.find('(');
  return bracket == std::string::npos ? text : text.insert(bracket, "<wbr>");
}

std::string StepItem(const ExplainedPlan& plan, std::size_t index, bool pictures) {
  const ExplainedStep& step = plan.steps[index];
  const int number = static_cast<int>(index) + 1;
  const std::string what = "step " + std::to_string(number) + ", " + step.name;
  std::string picture = Image(step.picture, "imagined picture after " + what);
  if (picture.empty() && pictures) {
    picture = Element("span", "class=\"none\"", step.imagined ? "no picture" : "not imagined");
  }
  const bool lost = number == plan.given_up;
  const bool same = !lost && number <= plan.shared;
  const std::string title =
      Element("b", "", std::to_string(number) + ".&nbsp;" + Breakable(step.name));
  return Element("li",
                 lost   ? "class=\"lost\""
                 : same ? "class=\"same\""
                        : "",
                 picture + title + "<br>" + Figures(step));
}

bool HasPictures(const ExplainedPlan& plan) {
  return std::any_of(plan.steps.begin(), plan.steps.end(),
                     [](const ExplainedStep& step) { return !step.picture.empty(); });
}

std::string Steps(const ExplainedPlan& plan) {
  if (plan.steps.empty()) return "";
  const bool pictures = HasPictures(plan);
  std::string items;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) items += StepItem(plan, i, pictures) + "\n";
  return Element("ol", "class=\"steps\"", "\n" + items) + "\n";
}

std::string Verdict(const Explanation& explanation) {
  std::string words =
      Paragraph("Prospect: " + explanation.task + ", " + SceneWords(explanation.seed),
                "class=\"faint\"") +
      Element("h1", explanation.act ? "class=\"act\"" : "class=\"refuse\"",
              Escaped(Headline(explanation))) +
      "\n";
  words += Paragraph(ScoreSentence(explanation));
  if (!explanation.goal.empty())
    words += Paragraph("Goal: " + base::Joined(explanation.goal) + ".");
  if (!explanation.not_covered.empty()) words += Paragraph(explanation.not_covered);
  for (const auto& sentence : ConfidenceSentences(explanation.confidence, explanation.terms))
    words += Paragraph(sentence);
  words += Paragraph(
      std::string("The score is V after the last step times f of every step. It is the networks' "
                  "own estimate and ranks plans; it is not a share counted on trials") +
          (explanation.confidence ? ": that is what the calibration adds." : "."),
      "class=\"faint\"");
  std::string seen = Image(explanation.seen, "what the camera sees now");
  if (!seen.empty()) {
    seen = Element("figure", "",
                   seen + Element("figcaption", "class=\"faint\"", "What the camera sees"));
  }
  return Element("div", "class=\"verdict\"", seen + Element("div", "", "\n" + words)) + "\n";
}

std::string Heading(const std::string& text) { return Element("h2", "", Escaped(text)) + "\n"; }

// Whether the networks can know what they look at.
std::string Recognised(const Explanation& explanation) {
  if (!explanation.familiarity) return "";
  const Familiarity& familiarity = *explanation.familiarity;
  std::string figures;
  const auto add = [&](const sim::Image& picture, const std::string& words) {
    const std::string image = Image(picture, words);
    if (image.empty()) return;
    const std::string caption = Element("figcaption", "class=\"faint\"", Escaped(words));
    figures += Element("figure", "", image + caption) + "\n";
  };
  if (!familiarity.redrawn.empty()) {
    add(familiarity.seen, "What the camera sees");
    add(familiarity.redrawn, "What the networks make of it");
    add(DifferenceMap(familiarity.seen, familiarity.redrawn), "Where the two differ");
  }
  return Heading(familiarity.foreign() ? "The picture is unlike known ones"
                                       : "The picture is like known ones") +
         Paragraph(FamiliaritySentence(familiarity)) +
         Paragraph(
             "p: how usual it would be, among first pictures of scenes kept for calibration, "
             "to be redrawn as badly or to lie as far from the others; pictures below " +
                 base::Number("%g", familiarity.level) + " are refused.",
             "class=\"faint\"") +
         (figures.empty() ? "" : Element("div", "class=\"row\"", "\n" + figures) + "\n");
}

std::string ScoreOf(const ExplainedPlan& plan) {
  const bool scored = !plan.steps.empty() && plan.steps.back().imagined;
  return scored ? ": score " + base::Number("%.2f", plan.score) : "";
}

std::string Chosen(const Explanation& explanation) {
  if (explanation.chosen.steps.empty()) return "";
  std::string text = Heading((explanation.act ? "The chosen plan" : "The best that was imagined") +
                             ScoreOf(explanation.chosen));
  text += Paragraph(
      "Each picture is what the networks expect to see after the step. V: expected "
      "chance of success from there. f: expected chance that the step gets done. "
      "V of the scene as it is: " +
          base::Number("%.2f", explanation.root_value) + ".",
      "class=\"faint\"");
  return text + Steps(explanation.chosen) + Paragraph(explanation.chosen.why);
}

std::string Named(const Explanation& explanation) {
  if (!explanation.what_if) return "";
  std::string text =
      Heading("What if: the plan that was named" + ScoreOf(explanation.what_if->plan));
  for (const auto& finding : explanation.what_if->findings) text += Paragraph(finding);
  return text + Steps(explanation.what_if->plan);
}

std::string AlternativeTitle(const ExplainedPlan& plan, int number) {
  std::string title = std::to_string(number) + ". ";
  const auto shared = static_cast<std::size_t>(plan.shared);
  if (shared == 0 || shared >= plan.steps.size())
    return title + "Begin with " + plan.steps.front().name;
  title +=
      shared == 1 ? "The same first step" : "The same first " + std::to_string(shared) + " steps";
  return title + ", then " + plan.steps[shared].name;
}

std::string Alternative(const ExplainedPlan& plan, int number) {
  return Element("h3", "", Escaped(AlternativeTitle(plan, number))) + "\n" + Paragraph(plan.why) +
         Steps(plan);
}

std::string Others(const Explanation& explanation) {
  if (explanation.ended_by.empty()) return "";
  std::string text = Heading(explanation.act ? "The best alternatives, and why each lost"
                                             : "What else was imagined, and why it fails");
  if (explanation.alternatives.empty()) text += Paragraph("Nothing else was imagined to its end.");
  int number = 0;
  for (const auto& plan : explanation.alternatives) text += Alternative(plan, ++number);
  if (!explanation.ruled_out.empty()) {
    text += Paragraph("Ruled out from the start by p, without imagining them: " +
                      base::Joined(explanation.ruled_out) + ".");
  }
  if (!explanation.untried.empty()) {
    text += Paragraph("Of these first actions no future was followed to its end: " +
                      base::Joined(explanation.untried) + ".");
  }
  return text;
}

std::string Row(const std::string& name, const std::string& value) {
  return Element(
             "tr", "",
             Element("th", "scope=\"row\"", Escaped(name)) + Element("td", "", Escaped(value))) +
         "\n";
}

std::string Ending(const std::string& ended_by) {
  if (ended_by == "samples") return "";
  if (ended_by == "exhausted") return ": then every future was known";
  if (ended_by == "deadline") return ": then its time was up";
  return ": then it ended (" + ended_by + ")";
}

// What other thresholds would lead to.
std::string Refusing(const Explanation& explanation) {
  if (!explanation.terms) return "";
  const double threshold = explanation.parameters.refusal_threshold;
  const std::string chart = RiskChart(*explanation.terms, threshold);
  if (chart.empty()) return "";
  return Heading("When to refuse") +
         Paragraph("Plans were searched for and carried out in " +
                       std::to_string(explanation.terms->sample) +
                       " calibration scenes. The stricter the threshold on the score, the fewer "
                       "are attempted and the fewer of these fail; the point is the threshold at "
                       "hand, " +
                       base::Number("%.3f", threshold) + ".",
                   "class=\"faint\"") +
         chart;
}

std::string HowTheSearchWent(const Explanation& explanation) {
  const auto& limits = explanation.parameters;
  if (explanation.ended_by.empty()) return Heading("Nothing was searched");
  std::string rows =
      Row("Rollouts", std::to_string(explanation.rollouts) + " of " +
                          std::to_string(limits.samples) + Ending(explanation.ended_by)) +
      Row("Imagined states", std::to_string(explanation.evaluations)) +
      Row("Workers", std::to_string(explanation.workers)) +
      Row("Time", base::Number("%.2f s", explanation.seconds)) +
      Row("Rule", limits.rule + ", " + std::to_string(limits.depth) + " actions ahead of " +
                      std::to_string(explanation.plan_length) + " in a whole plan") +
      Row("Gives up", "V below " + base::Number("%g", limits.v_failed) + ", f below " +
                          base::Number("%g", limits.c_done) + ", p below " +
                          base::Number("%g", limits.p_min)) +
      Row("Search seed", std::to_string(limits.seed)) + Row("Task", explanation.task) +
      Row("Scene", explanation.seed < 0 ? "as it stood" : std::to_string(explanation.seed)) +
      Row("Weights", explanation.weights + " (" + explanation.engine + ")");
  return Heading("How the search went") + Element("table", "", "\n" + rows) + "\n";
}

}  // namespace

std::string ExplanationPage(const Explanation& explanation) {
  const std::string title = "Prospect: " + Headline(explanation);
  const std::string recognised = Recognised(explanation);
  const bool foreign = explanation.familiarity && explanation.familiarity->foreign();
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
         Element("title", "", Escaped(title)) + "\n" + Element("style", "", kStyle) +
         "\n</head>\n<body>\n" + Verdict(explanation) + (foreign ? recognised : "") +
         Chosen(explanation) + Named(explanation) + Others(explanation) + Refusing(explanation) +
         (foreign ? "" : recognised) + HowTheSearchWent(explanation) + "</body>\n</html>\n";
}

}  // namespace prospect::report

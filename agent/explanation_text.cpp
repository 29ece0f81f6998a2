#include "agent/explanation_text.h"

#include <cstdio>

#include "base/number_format.h"
#include "base/text.h"

namespace prospect::agent {
namespace {

using base::Apart;

// With a capital and a full stop.
std::string Sentence(std::string text) {
  if (text.empty()) return text;
  if (text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text.back() == '.' ? text : text + ".";
}

std::string StepLine(std::size_t number, const ExplainedStep& step) {
  char line[200];
  if (step.imagined) {
    std::snprintf(line, sizeof line, "%4zu  %-24s %7.3f %7.3f %7.3f %7.3f\n", number,
                  step.name.c_str(), step.score, step.value, step.done, step.prior);
  } else {
    const std::string prior = step.prior >= 0 ? base::Fixed(step.prior, 3) : "-";
    std::snprintf(line, sizeof line, "%4zu  %-24s %7s %7s %7s %7s\n", number, step.name.c_str(),
                  "-", "-", "-", prior.c_str());
  }
  return line;
}

std::string Table(const ExplainedPlan& plan) {
  std::string text = "Step  Action                     Score       V       f       p\n";
  for (std::size_t i = 0; i < plan.steps.size(); ++i) text += StepLine(i + 1, plan.steps[i]);
  return text;
}

std::string Chain(const ExplainedPlan& plan) {
  std::vector<std::string> names;
  for (const auto& step : plan.steps) names.push_back(step.name);
  return base::Joined(names);
}

std::string WhatIfText(const WhatIf& what_if) {
  std::string text = "\nWhat if: " + Chain(what_if.plan) + "\n" + Table(what_if.plan);
  for (const auto& finding : what_if.findings) text += "  " + finding + '\n';
  return text;
}

}  // namespace

std::string Headline(const Explanation& explanation) {
  if (!explanation.act) return "Refuse";
  return "Act: begin with " + explanation.chosen.steps.front().name;
}

std::string ScoreSentence(const Explanation& explanation) {
  const double score = explanation.score, threshold = explanation.parameters.refusal_threshold;
  if (!explanation.act) return Sentence(explanation.reason);
  const std::string compared = threshold > 0
                                   ? "; plans below " + Apart(threshold, score) + " are refused"
                                   : "; no threshold is set, so no plan is refused for its score";
  return "Score " + Apart(score, threshold) + compared + ".";
}

std::string ExplanationText(const Explanation& explanation, int most) {
  std::string text = Headline(explanation) + ". " + ScoreSentence(explanation) + '\n';
  if (!explanation.not_covered.empty()) text += explanation.not_covered + '\n';
  for (const auto& sentence : ConfidenceSentences(explanation.confidence, explanation.terms))
    text += sentence + '\n';
  if (explanation.terms) text += explanation.terms->table;
  if (!explanation.chosen.steps.empty()) {
    text += explanation.act ? "" : "The best that was imagined:\n";
    text += Table(explanation.chosen);
  }
  if (!explanation.chosen.why.empty()) text += "  " + explanation.chosen.why + '\n';
  int shown = 0;
  for (const auto& other : explanation.alternatives) {
    if (shown++ == most) break;
    text += (shown == 1 ? "\nAlternatives:\n" : "") + std::string("- ") + Chain(other) + "\n  " +
            other.why + '\n';
  }
  if (explanation.what_if) text += WhatIfText(*explanation.what_if);
  if (explanation.familiarity && !explanation.familiarity->foreign())
    text += '\n' + FamiliaritySentence(*explanation.familiarity) + '\n';
  return text;
}

}  // namespace prospect::agent

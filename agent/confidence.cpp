#include "agent/confidence.h"

#include "agent/plan_context.h"
#include "base/number_format.h"
#include "base/text.h"
#include "model/refusal/isotonic.h"

namespace prospect::agent {
std::optional<Confidence> ConfidenceOf(const model::CalibrationSample& sample, double score,
                                       double threshold) {
  model::CalibrationSample attempted;
  for (const auto& scene : sample.scenes) {
    if (scene.attempted() && scene.score >= threshold) attempted.scenes.push_back(scene);
  }
  const model::SuccessCurve success(attempted);
  if (success.empty() || score < success.blocks().front().low ||
      score > success.blocks().back().high)
    return std::nullopt;
  const model::SuccessBlock& block = success.At(score);
  return Confidence{block.scenes, block.solved, block.low, block.high};
}

RefusalTerms TermsOf(const model::CalibrationSample& sample, const std::string& rule,
                     const std::map<std::string, double>& parameters, bool goal) {
  RefusalTerms terms;
  terms.sample = static_cast<int>(sample.scenes.size());
  terms.curve = model::RiskCoverageCurve(sample);
  std::vector<std::string> differences = model::Differences(sample, rule, parameters);
  if (goal) differences.emplace_back("a goal, where the calibration had the task's own");
  if (!differences.empty())
    terms.caveat = "The calibration does not cover this search: " + base::Joined(differences) + ".";
  return terms;
}

std::string SuccessSentence(const Confidence& confidence) {
  return "Succeeds in about " + base::Number("%.0f %%", 100 * confidence.share()) + ": of " +
         std::to_string(confidence.scenes) + " calibration scenes whose plan scored " +
         base::Number("%.3f", confidence.low) + " to " + base::Number("%.3f", confidence.high) +
         ", " + std::to_string(confidence.solved) + " were solved.";
}

std::vector<std::string> ConfidenceSentences(const std::optional<Confidence>& confidence,
                                             const std::optional<RefusalTerms>& terms) {
  std::vector<std::string> sentences;
  if (confidence) sentences.push_back(SuccessSentence(*confidence));
  if (!terms) return sentences;
  sentences.insert(sentences.end(), terms->promises.begin(), terms->promises.end());
  if (!sentences.empty() && !terms->caveat.empty()) sentences.push_back(terms->caveat);
  return sentences;
}

}  // namespace prospect::agent

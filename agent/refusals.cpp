#include "agent/refusals.h"

#include <map>

#include "agent/errors.h"

namespace prospect::agent {

Refusals::Refusals(Mind& mind, const MindInfo& info, const EpisodeOptions& options,
                   const model::SceneKind& kind, Listener& listener)
    : plan_length_(kind.plan_length),
      chosen_(options.refusal_threshold >= 0 || options.promise.asked()),
      threshold_(options.refusal_threshold) {
  const std::vector<model::CalibrationSample> samples = mind.Calibrations(options.promise.asked());
  const model::CalibrationSample* covering = model::CoveringSample(samples, kind);
  if (covering != nullptr) sample_ = *covering;
  if (!samples.empty()) rule_ = sample_ ? sample_->rule : samples.front().rule;
  not_covered_ = model::NotCovered(samples, kind);
  if (!not_covered_.empty()) listener.Warn(not_covered_);
  if (options.promise.asked()) {
    if (!not_covered_.empty()) throw PromiseError("nothing can be promised: " + not_covered_);
    promised_ = model::ThresholdFor(*sample_, options.promise);
    threshold_ = promised_.value;
    for (const std::string& sentence : promised_.words) listener.Note(sentence);
  } else if (!chosen_) {
    threshold_ = OwnThreshold(info);
  }
}

// Of the weights. Where they know nothing of such scenes nothing is refused for its score: there is
// an objection to all of it.
double Refusals::OwnThreshold(const MindInfo& info) const {
  if (sample_) return sample_->refusal_threshold;
  return not_covered_.empty() ? info.refusal_threshold : 0;
}

std::string Refusals::Objection() const {
  if (not_covered_.empty() || chosen_) return "";
  return not_covered_ + " --refusal-threshold X attempts plans that score X or more all the same";
}

std::optional<RefusalTerms> Refusals::Terms(const EpisodeOptions& options, bool goal) const {
  if (!sample_) return std::nullopt;
  const planner::SearchParameters& search = options.search;
  const std::map<std::string, double> parameters = {
      {"samples", static_cast<double>(search.samples)},
      {"c", search.c},
      {"c_done", search.c_done},
      {"v_failed", search.v_failed},
      {"p_min", search.p_min},
      {"plan_length", plan_length_},
      {"retries", options.retries}};
  RefusalTerms terms = TermsOf(*sample_, search.rule, parameters, goal);
  terms.promises = promised_.words;
  if (!promised_.kept) terms.table = model::CurveTable(*sample_);
  return terms;
}

std::optional<Confidence> Refusals::ConfidenceIn(double score) const {
  if (!sample_) return std::nullopt;
  return ConfidenceOf(*sample_, score, threshold_);
}

}  // namespace prospect::agent

#include "agent/refusals.h"

#include <map>

#include "agent/errors.h"

namespace prospect::agent {

Refusals::Refusals(Mind& mind, const MindInfo& info, const EpisodeOptions& options,
                   const model::SceneKind& kind, Listener& listener)
    : mind_(mind),
      plan_length_(kind.plan_length),
      chosen_(options.refusal_threshold >= 0 || options.promise.asked()),
      threshold_(options.refusal_threshold) {
  const model::CalibrationSample* sample = mind.Calibration(options.promise.asked());
  if (sample != nullptr) not_covered_ = model::NotCovered(*sample, kind);
  if (!not_covered_.empty()) listener.Warn(not_covered_);
  if (options.promise.asked()) {
    if (!not_covered_.empty()) throw PromiseError("nothing can be promised: " + not_covered_);
    promised_ = model::ThresholdFor(*sample, options.promise);
    threshold_ = promised_.value;
    for (const std::string& sentence : promised_.words) listener.Note(sentence);
  } else if (!chosen_) {
    threshold_ = not_covered_.empty() ? info.refusal_threshold : 0;
  }
}

std::string Refusals::Objection() const {
  if (not_covered_.empty() || chosen_) return "";
  return not_covered_ + " --refusal-threshold X attempts plans that score X or more all the same";
}

const model::CalibrationSample* Refusals::Sample() const {
  return not_covered_.empty() ? mind_.Calibration(false) : nullptr;
}

std::optional<RefusalTerms> Refusals::Terms(const EpisodeOptions& options, bool goal) const {
  const model::CalibrationSample* sample = Sample();
  if (sample == nullptr) return std::nullopt;
  const planner::SearchParameters& search = options.search;
  const std::map<std::string, double> parameters = {
      {"samples", static_cast<double>(search.samples)},
      {"c", search.c},
      {"c_done", search.c_done},
      {"v_failed", search.v_failed},
      {"p_min", search.p_min},
      {"plan_length", plan_length_},
      {"retries", options.retries}};
  RefusalTerms terms = TermsOf(*sample, search.rule, parameters, goal);
  terms.promises = promised_.words;
  if (!promised_.kept) terms.table = model::CurveTable(*sample);
  return terms;
}

std::optional<Confidence> Refusals::ConfidenceIn(double score) const {
  const model::CalibrationSample* sample = Sample();
  if (sample == nullptr) return std::nullopt;
  return ConfidenceOf(*sample, score, threshold_);
}

}  // namespace prospect::agent

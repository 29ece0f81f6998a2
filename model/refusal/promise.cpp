#include "model/refusal/promise.h"

#include <algorithm>
#include <cstdio>

#include "base/number_format.h"
#include "model/refusal/risk_coverage.h"

namespace prospect::model {
namespace {

constexpr int kScoreDigits = 3;

std::string Score(double x) { return base::Fixed(x, kScoreDigits); }

std::string Of(int count, int scenes, const char* what) {
  return std::to_string(count) + " of " + std::to_string(scenes) + " " + what;
}

std::string RefuseWords(const ThresholdBound& bound, double alpha) {
  const std::string asked =
      "To refuse at most " + PercentText(alpha) + " of what can be done cannot be promised: ";
  if (bound.kept) {
    return "Refuses at most " + PercentText(alpha) + " of what can be done: the threshold " +
           Score(bound.value) + " refuses " + Of(bound.count, bound.scenes, "solvable") +
           " calibration scenes.";
  }
  if (bound.count > 0 || alpha * (bound.scenes + 1) >= 1)
    return asked + "for too many of the " + std::to_string(bound.scenes) +
           " solvable calibration scenes there was no plan at any threshold.";
  return asked + Of(0, bound.scenes, "solvable calibration scenes") +
         " may be refused then; more are needed.";
}

std::string FailWords(const ThresholdBound& bound, const Promise& promise) {
  const std::string what = PercentText(*promise.fail_at_most) + " of what is attempted";
  const std::string sure = " (with confidence " + PercentText(1 - promise.delta) + ")";
  if (bound.kept) {
    return "Fails at most " + what + sure + ": at threshold " + Score(bound.value) + " " +
           Of(bound.count, bound.scenes, "attempted") + " calibration scenes failed.";
  }
  return "To fail at most " + what + " cannot be promised" + sure +
         ": at no threshold did the calibration scenes show it.";
}

std::string NotBothWords(const CalibrationSample& sample, const PromisedThreshold& t) {
  const int solvable = CountOf(sample, SceneClass::kSolvable);
  return "Both cannot be had: the first takes a threshold of at most " +
         base::Apart(t.refuse.value, t.fail.value, kScoreDigits) + ", the second of at least " +
         base::Apart(t.fail.value, t.refuse.value, kScoreDigits) +
         ". The second holds, which refuses " +
         Of(EffectOf(sample, t.value).refused_solvable, solvable, "solvable calibration scenes") +
         ".";
}

// What was asked of refusing cannot be kept together with what was asked of failing.
void Reconcile(const CalibrationSample& sample, PromisedThreshold* t) {
  if (!t->refuse.kept || t->refuse.value < t->fail.value) {
    t->value = t->fail.value;
    t->kept = false;
    if (t->refuse.kept) t->words.push_back(NotBothWords(sample, *t));
  } else {
    t->value = t->refuse.value;
  }
}

std::string CurveRow(const CalibrationSample& sample, const ThresholdEffect& effect) {
  const auto share = [](int count, int all) { return all > 0 ? 100.0 * count / all : 0.0; };
  char line[160];
  std::snprintf(line, sizeof line, "%10.3f %9.1f %% %9.1f %% %9.1f %% %12.1f %% %12.1f %%\n",
                effect.threshold, 100 * effect.coverage, share(effect.solved, effect.attempted),
                100 * effect.risk,
                share(effect.refused_solvable, CountOf(sample, SceneClass::kSolvable)),
                share(effect.refused_hopeless, CountOf(sample, SceneClass::kHopeless)));
  return line;
}

}  // namespace

std::string PercentText(double share) { return base::Number("%.3g %%", 100 * share); }

PromisedThreshold ThresholdFor(const CalibrationSample& sample, const Promise& promise) {
  PromisedThreshold t;
  if (promise.refuse_at_most) {
    t.refuse = RefuseAtMost(sample, *promise.refuse_at_most);
    t.value = t.refuse.value;
    t.kept = t.refuse.kept;
    t.words.push_back(RefuseWords(t.refuse, *promise.refuse_at_most));
  }
  if (!promise.fail_at_most) return t;
  t.fail = FailAtMost(sample, *promise.fail_at_most, promise.delta);
  t.words.push_back(FailWords(t.fail, promise));
  if (!t.fail.kept) {
    t.may_attempt = t.kept = false;
  } else if (promise.refuse_at_most) {
    Reconcile(sample, &t);
  } else {
    t.value = t.fail.value;
  }
  return t;
}

std::vector<std::string> Differences(const CalibrationSample& sample, const std::string& rule,
                                     const std::map<std::string, double>& parameters) {
  std::vector<std::string> words;
  if (rule != sample.rule) words.push_back("rule " + rule + " instead of " + sample.rule);
  for (const auto& [name, value] : parameters) {
    const auto found = sample.parameters.find(name);
    if (found == sample.parameters.end() || found->second == value) continue;
    char text[120];
    std::snprintf(text, sizeof text, "%s %g instead of %g", name.c_str(), value, found->second);
    words.emplace_back(text);
  }
  return words;
}

std::string CurveTable(const CalibrationSample& sample, int rows) {
  std::string text =
      " threshold   attempted      solved      failed  of solvable     of hopeless\n"
      "                        of attempted of attempted   refused         refused\n";
  const std::vector<ThresholdEffect> curve = RiskCoverageCurve(sample);
  text += CurveRow(sample, EffectOf(sample, 0));
  const std::size_t points = curve.size();
  for (int row = 1; row < rows && points > 0; ++row) {
    // Even steps of coverage, from all downwards.
    const auto at =
        (points - 1) * static_cast<std::size_t>(rows - row) / static_cast<std::size_t>(rows);
    text += CurveRow(sample, curve[at]);
  }
  return text;
}

}  // namespace prospect::model

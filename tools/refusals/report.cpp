#include "tools/refusals/report.h"

#include <cstdio>

#include "model/refusal/isotonic.h"
#include "model/refusal/risk_coverage.h"
#include "tools/common/extent.h"

namespace prospect::tools {
namespace {

using model::SceneClass;
using nlohmann::json;

json ToJson(const SplitSummary& summary) {
  json result = {{"target", summary.target}, {"splits", summary.splits.size()},
                 {"kept", summary.kept},     {"within", summary.within},
                 {"mean", summary.mean},     {"standard_error", summary.standard_error},
                 {"rates", json::array()},   {"thresholds", json::array()},
                 {"bands", json::array()}};
  for (const SplitOutcome& split : summary.splits) {
    if (!split.kept) continue;
    result["rates"].push_back(split.rate());
    result["thresholds"].push_back(split.threshold);
    const double total = split.total > 0 ? split.total : 1;
    result["bands"].push_back({split.band.low / total, split.band.high / total});
  }
  return result;
}

json ToJson(const std::vector<model::ThresholdEffect>& curve, int solvable, int hopeless) {
  const auto share = [](int count, int all) {
    return all > 0 ? static_cast<double>(count) / all : 0.0;
  };
  json points = json::array();
  for (const model::ThresholdEffect& effect : curve) {
    points.push_back({{"threshold", effect.threshold},
                      {"coverage", effect.coverage},
                      {"risk", effect.risk},
                      {"solved_attempted", share(effect.solved, effect.attempted)},
                      {"refused_solvable", share(effect.refused_solvable, solvable)},
                      {"refused_hopeless", share(effect.refused_hopeless, hopeless)}});
  }
  return points;
}

json ToJson(const model::SuccessCurve& success) {
  json blocks = json::array();
  for (const model::SuccessBlock& block : success.blocks()) {
    blocks.push_back({{"low", block.low},
                      {"high", block.high},
                      {"scenes", block.scenes},
                      {"solved", block.solved}});
  }
  return blocks;
}

std::string Line(const char* format, double value) {
  char line[160];
  std::snprintf(line, sizeof line, format, value);
  return line;
}

std::string SplitsLine(const char* what, const json& summary) {
  char line[200];
  std::snprintf(line, sizeof line,
                "  %-28s at most %5.1f %%   mean %5.2f %% (standard error %.2f)   %d of %d in the "
                "95 %% band\n",
                what, 100 * summary["target"].get<double>(), 100 * summary["mean"].get<double>(),
                100 * summary["standard_error"].get<double>(), summary["within"].get<int>(),
                summary["kept"].get<int>());
  const int without = summary["splits"].get<int>() - summary["kept"].get<int>();
  if (without == 0) return line;
  return line + std::string("    in ") + std::to_string(without) +
         " splits no threshold could promise it\n";
}

}  // namespace

json MeasureRefusals(const model::CalibrationSample& sample, const std::string& task,
                     const RefusalOptions& options) {
  const int solvable = model::CountOf(sample, SceneClass::kSolvable);
  const int hopeless = model::CountOf(sample, SceneClass::kHopeless);
  const auto curve = model::RiskCoverageCurve(sample);
  const SplitSummary refuse = RunRefuseSplits(sample, options.alpha, options.splits, options.seed);
  const SplitSummary fail =
      RunFailSplits(sample, options.epsilon, options.delta, options.splits, options.seed);
  json figures = {{"task", task},
                  {"scenes", sample.scenes.size()},
                  {"solvable", solvable},
                  {"hopeless", hopeless},
                  {"doubtful", model::CountOf(sample, SceneClass::kDoubtful)},
                  {"auroc", model::SolvabilityAuroc(sample)},
                  {"area", model::AreaUnder(curve)},
                  {"coverage_at_5", model::CoverageAtRisk(curve, 0.05)},
                  {"coverage_at_10", model::CoverageAtRisk(curve, 0.1)},
                  {"delta", options.delta},
                  {"refuse", ToJson(refuse)},
                  {"fail", ToJson(fail)},
                  {"curve", ToJson(curve, solvable, hopeless)},
                  {"success", ToJson(model::SuccessCurve(sample))}};
  Extent{static_cast<int>(fail.splits.size()), options.splits}.Put(&figures);
  return figures;
}

std::string RefusalTable(const json& figures) {
  std::string text = figures["task"].get<std::string>() + ": " +
                     std::to_string(figures["scenes"].get<int>()) + " scenes, " +
                     std::to_string(figures["solvable"].get<int>()) + " solvable, " +
                     std::to_string(figures["hopeless"].get<int>()) + " hopeless, " +
                     std::to_string(figures["doubtful"].get<int>()) + " doubtful\n";
  text += "  over " + std::to_string(figures["refuse"]["splits"].get<int>()) +
          " random halves to calibrate on, the other half to test:\n";
  text += SplitsLine("refused of the solvable", figures["refuse"]);
  text += SplitsLine("failed of the attempted", figures["fail"]);
  const Extent extent{figures["fail"]["splits"].get<int>(), figures["wanted"].get<int>()};
  if (extent.stopped()) text += "  " + extent.Line("splits");
  text += Line("  score of solvable above hopeless (area under ROC)  %.3f\n", figures["auroc"]);
  text += Line("  area under risk and coverage                       %.4f\n", figures["area"]);
  text += Line("  attempted share of scenes at a risk of  5 %%        %.1f %%\n",
               100 * figures["coverage_at_5"].get<double>());
  text += Line("  attempted share of scenes at a risk of 10 %%        %.1f %%\n",
               100 * figures["coverage_at_10"].get<double>());
  return text;
}

}  // namespace prospect::tools

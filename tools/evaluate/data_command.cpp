#include "base/stop_signals.h"
#include "cli/options/task.h"
#include "cli/options/weights.h"
#include "cli/report_file.h"
#include "tools/common/progress.h"
#include "tools/common/recorded_report.h"
#include "tools/common/words.h"
#include "tools/evaluate/commands.h"
#include "tools/evaluate/decider.h"
#include "tools/evaluate/plan_rank.h"
#include "tools/evaluate/recorded.h"
#include "tools/evaluate/rule.h"

namespace prospect::tools {
namespace {

constexpr int kMostOthers = 50;  // legal plans that each recorded one is compared with

std::vector<PlanRank> RanksOf(const cli::EvaluateDataOptions& options, const Recorded& recorded) {
  const auto engine = model::LoadSearchEngine(recorded.weights, 1);
  const model::TrialFile file(options.data);
  const std::vector<std::size_t> trials = model::HeldOutTrials(file, options.all);
  Progress progress("plans ranked", static_cast<int>(trials.size()));
  return RankPlans(*engine, file, trials, RulesOf(cli::TaskOf(options.task).spec), kMostOthers,
                   [&progress] {
                     progress.Step();
                     if (base::StopRequested()) throw ExitError(kExitInterrupted, "stopped");
                   });
}

}  // namespace

int RunData(const cli::EvaluateDataOptions& options) {
  const std::string weights = cli::WeightsFile(options.weights, options.task);
  const Recorded recorded = JudgeData(options.data, weights, RuleOf(weights, {}), options.all);
  nlohmann::json report = ReportOf(recorded.judged, ActionNames(options.task),
                                   model::NoveltyGauge::Load(recorded.weights));
  report["task"] = cli::TaskOf(options.task).spec.name;
  report["all_trials"] = options.all;
  report["rank"] = ReportOf(RanksOf(options, recorded));
  Words() << RecordedWords(report) << RankWords(report["rank"]);
  cli::WriteReport(options.report, report);
  return kExitSuccess;
}

}  // namespace prospect::tools

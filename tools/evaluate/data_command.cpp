#include "cli/options/task.h"
#include "cli/options/weights.h"
#include "cli/report_file.h"
#include "tools/common/recorded_report.h"
#include "tools/common/words.h"
#include "tools/evaluate/commands.h"
#include "tools/evaluate/recorded.h"

namespace prospect::tools {

int RunData(const cli::EvaluateDataOptions& options) {
  const Recorded recorded =
      JudgeData(options.data, cli::WeightsFile(options.weights, options.task), options.all);
  nlohmann::json report = ReportOf(recorded.judged, ActionNames(options.task),
                                   model::NoveltyGauge::Load(recorded.weights));
  report["task"] = cli::TaskOf(options.task).spec.name;
  report["all_trials"] = options.all;
  Words() << RecordedWords(report);
  cli::WriteReport(options.report, report);
  return kExitSuccess;
}

}  // namespace prospect::tools

#include "services/check_robot/command.h"

#include <algorithm>
#include <cstdio>

#include "base/exit_codes.h"
#include "cli/options/task.h"
#include "cli/report_file.h"
#include "services/check_robot/robot_check.h"
#include "services/common/common_options.h"

namespace prospect::services {
namespace {

const char* Word(RobotFinding::Verdict verdict) {
  switch (verdict) {
    case RobotFinding::Verdict::kOk:
      return "ok";
    case RobotFinding::Verdict::kFault:
      return "FAULT";
    case RobotFinding::Verdict::kNote:
      return "note";
    case RobotFinding::Verdict::kNotTried:
      break;
  }
  return "not tried";
}

void Print(const std::vector<RobotFinding>& findings, std::ptrdiff_t faults) {
  for (const RobotFinding& finding : findings) {
    std::printf("%-10s %s%s%s\n", Word(finding.verdict), finding.rule.c_str(),
                finding.detail.empty() ? "" : ": ", finding.detail.c_str());
  }
  const auto notes = std::count_if(
      findings.begin(), findings.end(),
      [](const RobotFinding& finding) { return finding.verdict == RobotFinding::Verdict::kNote; });
  std::printf("%td of %td rules broken\n", faults,
              static_cast<std::ptrdiff_t>(findings.size()) - notes);
}

nlohmann::json ReportOf(const std::vector<RobotFinding>& findings, std::ptrdiff_t faults) {
  nlohmann::json rows = nlohmann::json::array();
  for (const RobotFinding& finding : findings) {
    rows.push_back(
        {{"rule", finding.rule}, {"verdict", Word(finding.verdict)}, {"detail", finding.detail}});
  }
  return {{"faults", faults}, {"rows", rows}};
}

}  // namespace

int RunCheckRobot(const cli::CheckRobotOptions& options) {
  ApplyCommonOptions(CommonOptions(options.bus), "check-robot");
  Bus bus(options.bus.bus);
  RobotCheck check(bus, options.task.empty() ? nullptr : &cli::TaskOf(options.task));
  const std::vector<RobotFinding> findings = check.Run();
  const auto faults = std::count_if(
      findings.begin(), findings.end(),
      [](const RobotFinding& finding) { return finding.verdict == RobotFinding::Verdict::kFault; });
  if (options.report.talks()) Print(findings, faults);
  cli::WriteReport(options.report, ReportOf(findings, faults));
  return faults == 0 ? kExitSuccess : kExitTaskFailure;
}

}  // namespace prospect::services

// prospect-check-robot: does whoever takes the simulator's place keep to the rules? Actions are
// really started.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/json_file.h"
#include "base/run_main.h"
#include "services/check_robot/robot_check.h"
#include "services/common/common_options.h"

namespace {

using namespace prospect;
using namespace prospect::services;

const char* Word(RobotFinding::Verdict verdict) {
  switch (verdict) {
    case RobotFinding::Verdict::kOk:
      return "ok";
    case RobotFinding::Verdict::kFault:
      return "FAULT";
    case RobotFinding::Verdict::kNotTried:
      break;
  }
  return "not tried";
}

int Report(const std::vector<RobotFinding>& findings, const std::string& json_file) {
  int faults = 0;
  nlohmann::json rows = nlohmann::json::array();
  for (const RobotFinding& finding : findings) {
    std::printf("%-10s %s%s%s\n", Word(finding.verdict), finding.rule.c_str(),
                finding.detail.empty() ? "" : ": ", finding.detail.c_str());
    if (finding.verdict == RobotFinding::Verdict::kFault) ++faults;
    rows.push_back(
        {{"rule", finding.rule}, {"verdict", Word(finding.verdict)}, {"detail", finding.detail}});
  }
  std::printf("%d of %zu rules broken\n", faults, findings.size());
  if (!json_file.empty())
    prospect::base::WriteJsonFile(json_file, {{"faults", faults}, {"rows", rows}});
  return faults == 0 ? kExitSuccess : kExitTaskFailure;
}

int Run(int argc, char** argv) {
  CLI::App app("Tries a robot, or the simulator, that is on the bus: actions are really started");
  CommonOptions common;
  std::string json_file;
  AddCommonOptions(app, common);
  app.add_option("--json", json_file, "also write the findings to this file");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  ApplyCommonOptions(common, "check-robot");
  Bus bus(common.bus);
  RobotCheck check(bus);
  return Report(check.Run(), json_file);
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}

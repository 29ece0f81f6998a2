// task check: what is wrong in a task file, and what is not there.

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "base/exit_codes.h"
#include "base/text.h"
#include "cli/installation.h"
#include "cli/options/task.h"
#include "cli/options/weights.h"
#include "cli/report_file.h"
#include "tasks/picture_size.h"
#include "tasks/plan_check.h"
#include "tools/common/task_training.h"
#include "tools/data/commands.h"

namespace prospect::tools {
namespace {

std::vector<std::string> NamesOf(const sim::TaskSpec& spec, const std::vector<int>& actions) {
  std::vector<std::string> names;
  for (const int action : actions)
    names.push_back(spec.actions[static_cast<std::size_t>(action)].name);
  return names;
}

std::vector<std::string> Remarks(const tasks::TaskFile& task) {
  std::vector<std::string> remarks;
  const auto never = NamesOf(task.spec, tasks::NeverReached(task.spec));
  if (!never.empty())
    remarks.push_back("by 'first' and 'follows' these never come: " + base::Joined(never));
  if (task.goals.empty() && !task.only_predicted)
    remarks.push_back("it has no goals, so that --goal cannot be used");
  if (task.spec.causes.empty())
    remarks.push_back("it has no causes, so that failures are told by the names the robot gives");
  const std::string size = tasks::PictureSizeRemark(task.spec.image_width, task.spec.image_height);
  if (!size.empty()) remarks.push_back(size);
  if (!std::filesystem::exists(cli::WeightsFile("", task.path)))
    remarks.push_back("no weights are bundled for '" + task.spec.name +
                      "': " + cli::Typed("train --task ") + task.path + " --data FILE makes them");
  return remarks;
}

void Print(const tasks::TaskFile& task, const nlohmann::json& report) {
  const auto listed = [&](const char* key) {
    return base::Joined(report.at(key).get<std::vector<std::string>>());
  };
  std::printf("%s: %s, %zu actions, plans of %d, pictures of %dx%d\n", task.path.c_str(),
              task.spec.name.c_str(), task.spec.actions.size(), task.spec.plan_length,
              task.spec.image_width, task.spec.image_height);
  std::printf("a plan begins with: %s\na plan ends with:   %s\n", listed("begins").c_str(),
              listed("ends").c_str());
  for (const std::string remark : report.at("remarks")) std::printf("note: %s\n", remark.c_str());
}

}  // namespace

int RunTaskCheck(const cli::TaskCheckOptions& options) {
  const tasks::TaskFile task = tasks::ReadTaskFile(options.file);
  TrainConfigOf(task);  // refuses bad settings
  const nlohmann::json report = {{"task", task.spec.name},
                                 {"begins", NamesOf(task.spec, task.spec.successors.back())},
                                 {"ends", NamesOf(task.spec, tasks::Completing(task.spec))},
                                 {"remarks", Remarks(task)}};
  if (options.report.talks()) Print(task, report);
  cli::WriteReport(options.report, report);
  return kExitSuccess;
}

}  // namespace prospect::tools

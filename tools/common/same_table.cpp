#include "tools/common/same_table.h"

#include "base/hash.h"

namespace prospect::tools {
namespace {

std::string Unequal(const std::string& what, const std::string& in_file,
                    const std::string& recorded) {
  if (in_file == recorded) return "";
  return what + " is " + in_file + " in the file, " + recorded + " in the data";
}

std::string Unequal(const std::string& what, int in_file, int recorded) {
  return Unequal(what, std::to_string(in_file), std::to_string(recorded));
}

}  // namespace

std::string TableDifference(const tasks::TaskFile& task, const model::Trial& trial) {
  const sim::TaskSpec& spec = task.spec;
  for (const std::string& difference :
       {Unequal("the name", spec.name, trial.task),
        Unequal("the number of actions", static_cast<int>(spec.actions.size()), trial.num_actions),
        Unequal("the width of pictures", spec.image_width, trial.width),
        Unequal("the height of pictures", spec.image_height, trial.height)}) {
    if (!difference.empty()) return difference;
  }
  if (base::HexText(spec.Hash()) == trial.task_hash) return "";
  return "names of actions, or what may follow what, are others";
}

void RequireSameTable(const tasks::TaskFile& task, const model::TrialFile& data) {
  if (data.size() == 0) return;
  const std::string difference = TableDifference(task, data.ReadLabels(0));
  if (difference.empty()) return;
  throw model::DataError(data.path() + ": was recorded with another task than " + task.path + ": " +
                         difference + "; name the file that it was recorded with, or record anew");
}

}  // namespace prospect::tools

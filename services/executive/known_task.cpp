#include "services/executive/known_task.h"

#include "base/exit_error.h"
#include "cli/options/task.h"
#include "services/binding/spec_messages.h"
#include "tasks/agreement.h"

namespace prospect::services {

std::optional<tasks::TaskFile> KnownTask(const std::string& wish, const task_t& task) {
  const tasks::TaskFile* file = wish.empty() ? cli::InstalledTask(task.name) : &cli::TaskOf(wish);
  if (file == nullptr) return std::nullopt;
  return tasks::ForScene(*file, SpecFromTask(task));
}

void RequireAgreement(const std::string& wish, const task_t& task, const std::string& bus) {
  const auto file = KnownTask(wish, task);
  if (!file) return;
  if (file->spec.name != task.name)
    throw ExitError(kExitUsage, "--task " + file->spec.name + ", but " + task.name + " is up on " +
                                    bus + ": leave the option out, or start another");
  if (file->only_predicted) return;
  const auto differences = tasks::DifferencesOf(*file, SpecFromTask(task));
  if (differences.empty()) return;
  throw ExitError(kExitUsage, "the robot and its task file do not agree: " +
                                  tasks::InWords(differences, *file) + "; correct one of them");
}

}  // namespace prospect::services

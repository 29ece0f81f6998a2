#pragma once

#include <optional>
#include <string>

#include "lcmtypes/messages.h"
#include "tasks/task_file.h"

namespace prospect::services {

// What is known of a task beside what the bus says: its file.

/// The file that --task names, else the installed one of TASK's name; nothing where there is none.
/// Throws tasks::TaskFileError where --task names a bad one.
std::optional<tasks::TaskFile> KnownTask(const std::string& wish, const task_t& task);

/// Throws ExitError (kExitUsage) where another task is up than is wished for, or where its robot
/// says another table than its file: which field, and both values. Tasks that are only predicted,
/// of which videos are played, are compared by name. @param wish as of --task; empty: none
void RequireAgreement(const std::string& wish, const task_t& task, const std::string& bus);

}  // namespace prospect::services

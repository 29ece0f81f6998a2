#pragma once

#include <functional>
#include <string>

#include "base/run_main.h"

namespace prospect::tools {

/// RunMain (base/run_main.h) for programs that compute with libtorch, of whose errors, as when a
/// GPU's memory is full, it tells the first line without the stack: kExitTaskFailure.
int RunTorchMain(const std::function<int()>& body, const std::string& prefix,
                 ExitCode others = kExitDisk);

}  // namespace prospect::tools

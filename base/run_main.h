#pragma once

#include <functional>
#include <string>

#include "base/exit_error.h"

namespace prospect {

/// Runs a program's body and turns what escapes it into a message on stderr, behind `prefix` and a
/// colon, and an exit status: ExitError gives its own, std::invalid_argument kExitUsage, an error
/// of the file system kExitDisk, any other exception `others`.
///
///   int main(int argc, char** argv) { return RunMain([&] { return Run(argc, argv); }); }
///
/// @param prefix whose error it is; programs that people start themselves give their name
int RunMain(const std::function<int()>& body, const std::string& prefix = "error",
            ExitCode others = kExitUnexpected);

}  // namespace prospect

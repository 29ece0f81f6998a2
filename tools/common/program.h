#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <stdexcept>

#include "tools/common/extent.h"

namespace prospect::tools {

/// The end of main() of a program that needs no libtorch (others: Guarded in guarded.h): runs,
/// tells errors on standard error after the program's name. Returns run()'s code;
/// std::invalid_argument 2, Interrupted 130, anything else thrown 13 (docs/architecture.md).
inline int RunProgram(const char* name, const std::function<int()>& run) {
  try {
    return run();
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 2;
  } catch (const Interrupted& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return kExitInterrupted;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 13;
  }
}

/// The same for programs whose options are not in the table of cli/ yet.
inline int RunProgram(const char* name, CLI::App* app, int argc, char** argv,
                      const std::function<int()>& run) {
  try {
    app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app->exit(error) == 0 ? 0 : 2;
  }
  return RunProgram(name, run);
}

}  // namespace prospect::tools

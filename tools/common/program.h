#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "base/run_main.h"

namespace prospect::tools {

/// main() of a program: reads the arguments (mistakes in them end with kExitUsage), and runs the
/// rest as RunMain does, telling errors after the program's name.
inline int RunProgram(const std::string& name, CLI::App* app, int argc, char** argv,
                      const std::function<int()>& run, ExitCode others = kExitDisk) {
  try {
    app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app->exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  return RunMain(run, name, others);
}

}  // namespace prospect::tools

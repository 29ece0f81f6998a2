#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "cli/command.h"

namespace prospect::cli {

using Words = std::vector<std::string>;

/// What was typed.
struct Invocation {
  const Command& command;
  const CLI::App& app;  ///< after parsing
  const Words& typed;   ///< arguments of the command
};

/// How `prospect` itself carries a command out.
struct Carrier {
  /// The programs that it will start, by name: ./prospect builds those that are not there.
  std::function<Words(const void* options)> programs;
  /// @return the exit status @throws ExitError, DiskError
  std::function<int(const void* options, const Invocation& invocation)> run;
};

/// nullptr: the command is carried out by Command::program alone.
const Carrier* FindCarrier(const std::string& command);

/// The options of `app` that were given and that `other` has, too, as arguments for a program that
/// parses with `other`: "--name=value".
Words HandedOn(const CLI::App& app, const CLI::App& other);

}  // namespace prospect::cli

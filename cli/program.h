#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/quiet.h"
#include "cli/fwd.h"

/// main() of the programs that carry commands out. One that carries several out is told by its
/// first argument which:
///
///   int main(int argc, char** argv) {
///     const std::vector<cli::Part> parts = {cli::Carries("oracle", "oracle", RunOracle), ...};
///     return RunMain([&] { return cli::RunPart(argc, argv, parts); });
///   }
namespace prospect::cli {

/// A command that a program carries out. Made by Carries().
struct Part {
  std::string word;     ///< the program's first argument; empty: the program does nothing else
  std::string command;  ///< its name in the table
  std::function<std::shared_ptr<void>(CLI::App&)> define;  ///< adds the options, which it returns
  std::function<std::string(const void*)> defect;          ///< as of Bound (cli/command.h)
  std::function<int(const void*)> run;                     ///< with the options
};

/// Keeps the process quiet (base/quiet.h) where the options say so.
template <typename Options>
void HeedQuiet(const Options& options) {
  if constexpr (requires { options.report; }) {
    base::SetQuiet(!options.report.talks());
  } else if constexpr (requires { options.quiet; }) {
    base::SetQuiet(options.quiet);
  }
}

/// @param run gets the options; its return value is the exit status
template <typename Options>
Part Carries(std::string word, std::string command, std::function<int(const Options&)> run) {
  Part part;
  part.word = std::move(word);
  part.command = std::move(command);
  part.define = [](CLI::App& app) {
    auto options = std::make_shared<Options>();
    Define(app, *options);
    return options;
  };
  part.defect = [](const void* options) {
    if constexpr (requires(const Options& o) { Defect(o); })
      return Defect(*static_cast<const Options*>(options));
    return std::string();
  };
  part.run = [run = std::move(run)](const void* options) {
    const auto& typed = *static_cast<const Options*>(options);
    HeedQuiet(typed);
    return run(typed);
  };
  return part;
}

template <typename Options>
Part Carries(std::string word, std::string command, int (*run)(const Options&)) {
  return Carries(std::move(word), std::move(command), std::function<int(const Options&)>(run));
}

/// Parses the arguments and runs the part that argv[1] names, or the only one if it has no word.
/// @return its status; 0 after --help; 2, told on standard error, after wrong arguments
int RunPart(int argc, const char* const* argv, const std::vector<Part>& parts);

}  // namespace prospect::cli

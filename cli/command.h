#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The one table of commands and options. `prospect` (main.cpp) prints help and completions from
/// it, checks what was typed, and starts the program that carries the command out; that program
/// parses its arguments with the very same definition. So an option's name, words, default and
/// check stand in one place.
///
/// How a command is added:
///  1. cli/commands/NAME.h: a plain struct `NameOptions` with defaults, and
///     `void Define(CLI::App& app, NameOptions& options);`
///     cli/commands/NAME.cpp: the options. What several commands have is a function of cli/options/
///     (task, scene, report, ...) that several Defines call. Every value is checked as it is parsed
///     (cli/values.h); what only shows where options meet goes into
///     `std::string Defect(const NameOptions& options);` (declared in NAME.h): empty, or what is
///     wrong.
///  2. cli/table.cpp: one entry.
///  3. The program: a line in its main() (cli/program.h). It links prospect_cli.
///  4. Nothing else: help, completion, --dry-run and the tests of tests/unit/cli read the table.
///
/// Rules. An option that may be left out, with a default that only the program knows, is a
/// std::optional or an empty string. --task: cli/options/task.h has the names and the one default.
/// A command that reports calls DefineReport (cli/options/report.h): --json FILE and --quiet.
namespace prospect::cli {

/// What a person wants who types a command: the paragraphs of `prospect --help`.
enum class Group { kTry, kRun, kLook, kTrain, kMeasure };

/// The options of one command once they are part of an app.
struct Bound {
  std::shared_ptr<void> options;        ///< the struct, filled by the app's parse()
  std::function<std::string()> defect;  ///< what is wrong with them taken together; empty: nothing
};

struct Command {
  std::string name;     ///< as it is typed: "train", "bench search"
  Group group;          ///
  std::string summary;  ///< one line for `prospect --help`, without a full stop
  /// The program that carries it out, from the folder of programs; empty: `prospect` itself, which
  /// may also prepare something before it (cli/run/carriers.h).
  std::string program = {};
  std::vector<std::string> arguments = {};  ///< of the program, before what was typed
  std::vector<std::string> also = {};       ///< other programs that it starts
  /// Adds the options to an app. Empty: not in this table yet, what was typed goes on unread.
  std::function<Bound(CLI::App&)> define = {};
};

/// Command::define for options that have Define() and, if need be, Defect().
template <typename Options>
std::function<Bound(CLI::App&)> Defined() {
  return [](CLI::App& app) {
    const auto options = std::make_shared<Options>();
    Define(app, *options);
    Bound bound{options, [] { return std::string(); }};
    if constexpr (requires { Defect(*options); }) {
      bound.defect = [options] { return Defect(*options); };
    }
    return bound;
  };
}

/// Sets an app up as all of ours are: named "./prospect NAME", with the command's summary and our
/// help. What is no command of the table is named as it is. Of an option that is given twice the
/// last one counts.
void SetUp(CLI::App& app, std::string_view command);

/// The options of `app` that were given and whose names ("--scenes") are wanted, as arguments in
/// the order of their definition: "--name=value".
std::vector<std::string> Given(const CLI::App& app,
                               const std::function<bool(const std::string&)>& wanted);

/// Parses `arguments` (without the program's name) and looks for the defect. @return the status to
/// end with: 0 after --help, 2 after what is wrong, which was told on standard error in one line;
/// nothing: go on
std::optional<int> ParseArguments(CLI::App& app, std::vector<std::string> arguments,
                                  const std::function<std::string()>& defect);

}  // namespace prospect::cli

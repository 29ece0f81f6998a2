// prospect: every command from one table. It tells help, checks what was typed, and becomes the
// program that carries the command out.
//   prospect COMMAND [ARGUMENT...]
//   prospect --dry-run COMMAND ...    only checks the arguments: 0, or 2
//   prospect --programs COMMAND ...   checks them and prints the programs that the command needs

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "base/nearest.h"
#include "base/run_main.h"
#include "cli/command.h"
#include "cli/help.h"
#include "cli/installation.h"
#include "cli/run/invocation.h"
#include "cli/run/processes.h"
#include "cli/table.h"

namespace prospect::cli {
namespace {

enum class Mode { kRun, kDryRun, kPrograms };

int Fail(int status, const std::string& what) {
  std::fprintf(stderr, "prospect: %s\n", what.c_str());
  return status;
}

// The command that `words` begin with, of which it is taken: of one word, or of two.
const Command* TakeCommand(Words* words) {
  for (const std::size_t length : {2, 1}) {
    if (words->size() < length) continue;
    const Command* found =
        FindCommand(length == 2 ? (*words)[0] + " " + (*words)[1] : words->front());
    if (found == nullptr) continue;
    words->erase(words->begin(), words->begin() + static_cast<std::ptrdiff_t>(length));
    return found;
  }
  return nullptr;
}

bool AsksForHelp(const Words& words) {
  return std::any_of(words.begin(), words.end(),
                     [](const std::string& word) { return word == "--help" || word == "-h"; });
}

int TellUnknown(const std::string& typed) {
  Words names;
  for (const Command& command : Commands()) names.push_back(command.name);
  const std::string nearest = base::NearestWord(typed, names);
  return Fail(2, "unknown command '" + typed + "'" +
                     (nearest.empty() ? "" : "; did you mean " + nearest + "?") + " (" +
                     TypedName() + " --help lists all)");
}

int BecomeProgram(const Command& command, const Words& typed) {
  Words words = StartOf(command);
  if (IsInstalled() && access(words[0].c_str(), X_OK) != 0) {
    return Fail(127, words[0] + " is missing; programs that train come with the Debian package " +
                         "prospect-train");
  }
  words.insert(words.end(), typed.begin(), typed.end());
  return Become(words);
}

void Print(const Words& programs) {
  for (const std::string& program : programs) std::printf("%s\n", program.c_str());
}

Words ProgramsOf(const Command& command, const Carrier* carrier, const void* options) {
  if (carrier != nullptr) return carrier->programs(options);
  Words programs = command.also;
  if (!command.program.empty()) programs.insert(programs.begin(), command.program);
  return programs;
}

int Carry(const Command& command, const Words& typed, Mode mode) {
  CLI::App app;
  SetUp(app, command.name);
  Bound bound;
  if (command.define) {
    bound = command.define(app);
    if (mode == Mode::kPrograms && AsksForHelp(typed)) return 0;
    if (const auto end = ParseArguments(app, typed, bound.defect)) return *end;
  }
  if (mode == Mode::kDryRun) return 0;
  const Carrier* carrier = FindCarrier(command.name);
  if (mode == Mode::kPrograms) {
    Print(ProgramsOf(command, carrier, bound.options.get()));
    return 0;
  }
  if (carrier != nullptr) return carrier->run(bound.options.get(), {command, app, typed});
  if (!command.program.empty()) return BecomeProgram(command, typed);
  return Fail(
      2, "'" + command.name + "' is for a checkout of the sources: ./prospect " + command.name);
}

Mode TakeMode(Words* words) {
  if (words->empty()) return Mode::kRun;
  const Mode mode = words->front() == "--dry-run"    ? Mode::kDryRun
                    : words->front() == "--programs" ? Mode::kPrograms
                                                     : Mode::kRun;
  if (mode != Mode::kRun) words->erase(words->begin());
  return mode;
}

int Run(Words words) {
  // Our programs spread rows over threads of their own; a BLAS that starts more only makes them
  // wait.
  setenv("OPENBLAS_NUM_THREADS", "1", 0);
  setenv("OMP_NUM_THREADS", "1", 0);
  const char* path = std::getenv("PATH");  // where ip lives, too
  setenv("PATH",
         ((path == nullptr ? "/usr/bin:/bin" : std::string(path)) + ":/usr/sbin:/sbin").c_str(), 1);
  const Mode mode = TakeMode(&words);
  if (!words.empty() && words.front() == "help") {  // "help train" is "train --help"
    words.erase(words.begin());
    words.push_back("--help");
  }
  if (words.empty() || words.front() == "--help" || words.front() == "-h") {
    if (mode == Mode::kPrograms) return 0;
    std::fputs(Overview(Commands()).c_str(), stdout);
    return 0;
  }
  const std::string typed = words.front();
  const Command* command = TakeCommand(&words);
  return command == nullptr ? TellUnknown(typed) : Carry(*command, words, mode);
}

}  // namespace
}  // namespace prospect::cli

int main(int argc, char** argv) {
  return prospect::RunMain(
      [&]() -> int {
        try {
          return prospect::cli::Run(std::vector<std::string>(argv + 1, argv + argc));
        } catch (const prospect::cli::Ended& ended) {
          return ended.status;
        }
      },
      "prospect");
}

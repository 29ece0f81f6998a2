// prospect: every command from one table. It tells help, checks what was typed, and becomes the
// program that carries the command out.
//   prospect COMMAND [ARGUMENT...]
//   prospect --dry-run COMMAND ...    only checks the arguments: 0, or 2
//   prospect --programs COMMAND ...   checks them and prints the programs that the command needs

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "cli/command.h"
#include "cli/help.h"
#include "cli/installation.h"
#include "cli/nearest.h"
#include "cli/table.h"

namespace prospect::cli {
namespace {

using Words = std::vector<std::string>;

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

int TellUnknown(const std::string& typed) {
  Words names;
  for (const Command& command : Commands()) names.push_back(command.name);
  const std::string nearest = NearestWord(typed, names);
  return Fail(2, "unknown command '" + typed + "'" +
                     (nearest.empty() ? "" : "; did you mean " + nearest + "?") +
                     " (./prospect --help lists all)");
}

int Become(const Command& command, const Words& typed) {
  const std::string path = ProgramsFolder() + "/" + command.program;
  Words words{path};
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  words.insert(words.end(), typed.begin(), typed.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(path.c_str(), argv.data());
  return Fail(127, path + ": " + std::strerror(errno));
}

void PrintPrograms(const Command& command) {
  if (!command.program.empty()) std::printf("%s\n", command.program.c_str());
  for (const std::string& program : command.also) std::printf("%s\n", program.c_str());
}

int Carry(const Command& command, const Words& typed, Mode mode) {
  if (command.define) {
    CLI::App app;
    SetUp(app, command.name);
    const Bound bound = command.define(app);
    if (const auto end = ParseArguments(app, typed, bound.defect)) return *end;
  }
  if (mode == Mode::kDryRun) return 0;
  if (mode == Mode::kPrograms) {
    PrintPrograms(command);
    return 0;
  }
  return Become(command, typed);
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
  const Mode mode = TakeMode(&words);
  if (!words.empty() && words.front() == "help") {  // "help train" is "train --help"
    words.erase(words.begin());
    words.push_back("--help");
  }
  if (words.empty() || words.front() == "--help" || words.front() == "-h") {
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
  return prospect::cli::Run(std::vector<std::string>(argv + 1, argv + argc));
}

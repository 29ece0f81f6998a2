#include "cli/program.h"

#include <cstdio>

#include "cli/command.h"

namespace prospect::cli {
namespace {

// @param argv what the options are in, from `first` on
int Run(const Part& part, int argc, const char* const* argv, int first) {
  CLI::App app;
  SetUp(app, part.command);
  const std::shared_ptr<void> options = part.define(app);
  const auto end = ParseArguments(app, std::vector<std::string>(argv + first, argv + argc),
                                  [&] { return part.defect(options.get()); });
  return end ? *end : part.run(options.get());
}

}  // namespace

int RunPart(int argc, const char* const* argv, const std::vector<Part>& parts) {
  const std::string word = argc > 1 ? argv[1] : "";
  std::string known;
  for (const Part& part : parts) {
    if (part.word.empty()) return Run(part, argc, argv, 1);
    if (part.word == word) return Run(part, argc, argv, 2);
    known += (known.empty() ? "" : ", ") + part.word;
  }
  const std::string path = argv[0];
  std::fprintf(stderr, "%s: give one of %s, not '%s'\n",
               path.substr(path.find_last_of('/') + 1).c_str(), known.c_str(), word.c_str());
  return 2;
}

}  // namespace prospect::cli

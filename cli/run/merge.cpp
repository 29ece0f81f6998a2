// merge: the program that made the parts puts them together.

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/exit_error.h"
#include "cli/installation.h"
#include "cli/run/carriers.h"
#include "cli/run/processes.h"
#include "cli/table.h"

namespace prospect::cli {
namespace {

constexpr char kDataProgram[] = "prospect-data";
constexpr std::string_view kHdf5 = "\x89HDF\r\n";

// Which program makes parts such as this file; empty: none.
std::string MakerOf(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string begin(kHdf5.size(), '\0');
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (begin == kHdf5) return kDataProgram;
  stream.clear();
  stream.seekg(0);
  const auto report = nlohmann::json::parse(stream, nullptr, false);
  const auto command = nlohmann::json::json_pointer("/part/command");
  if (!report.is_object() || !report.contains(command) || !report[command].is_string()) return "";
  const Command* made = FindCommand(report[command].get<std::string>());
  return made == nullptr ? "" : made->program;
}

}  // namespace

Words ProgramsOf(const MergeOptions& options) {
  const std::string maker = MakerOf(options.parts.front());
  return maker.empty() ? Words() : Words{maker};
}

int Run(const MergeOptions& options, const Invocation& invocation) {
  const std::string maker = MakerOf(options.parts.front());
  if (maker.empty()) {
    throw ExitError(kExitDataFile, options.parts.front() +
                                       ": is no part of a run (made with --shard), or is missing, "
                                       "cut off or damaged");
  }
  Words words{PathOf(maker), "merge"};
  words.insert(words.end(), invocation.typed.begin(), invocation.typed.end());
  return Become(words);
}

}  // namespace prospect::cli

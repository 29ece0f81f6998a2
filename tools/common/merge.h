#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.h"
#include "cli/commands/merge.h"
#include "cli/program.h"
#include "tools/common/parts.h"

namespace prospect::tools {

// A command whose reports may come in parts.
struct Mergeable {
  std::string command;
  std::function<int(const cli::MergeOptions&, const MergedRun&)> run;
};

// `run` carries the command out; its options have `shard` (cli/options/shard.h) and `report`. To
// merge is to carry it out once more with what the parts were asked for, and with their records in
// the place of work, so that there is one way from records to a report.
template <typename Options>
Mergeable Merges(const std::string& command, int (*run)(const Options&)) {
  const auto merge = [command, run](const cli::MergeOptions& asked, const MergedRun& merged) {
    CLI::App app;
    cli::SetUp(app, command);
    Options options;
    Define(app, options);
    const auto defect = [&options] { return Defect(options); };
    if (const auto end = cli::ParseArguments(app, merged.options, defect)) return *end;
    options.report = {.json = asked.out, .quiet = asked.quiet};
    options.shard.merged = std::make_shared<cli::MergedParts>(merged.parts);
    cli::HeedQuiet(options);
    return run(options);
  };
  return {command, merge};
}

// The program's part of `prospect merge`, for the reports of these commands.
inline cli::Part CarriesMerge(std::vector<Mergeable> commands) {
  return cli::Carries<cli::MergeOptions>(
      "merge", "merge", [commands = std::move(commands)](const cli::MergeOptions& options) {
        const MergedRun merged = ReadRecords(options.parts);
        for (const Mergeable& mergeable : commands)
          if (mergeable.command == merged.command) return mergeable.run(options, merged);
        throw PartError(options.parts.front() + ": holds a part of '" + merged.command +
                        "', which this program does not merge");
      });
}

}  // namespace prospect::tools

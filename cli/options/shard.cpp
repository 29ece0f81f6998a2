#include "cli/options/shard.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "cli/command.h"
#include "cli/values.h"

namespace prospect::cli {
namespace {

constexpr std::array kWithoutWeight = {"--help",  "--shard", "--jobs",       "--json",
                                       "--quiet", "--out",   "--keep-parts", "--resume"};

// Whether what comes out depends on the option.
bool HasWeight(const std::string& name) {
  return std::find(kWithoutWeight.begin(), kWithoutWeight.end(), name) == kWithoutWeight.end();
}

}  // namespace

void DefineShard(CLI::App& app, ShardOptions& shard) {
  app.add_option_function<std::string>(
         "--shard",
         [&shard](const std::string& text) {
           const std::size_t slash = text.find('/');
           shard.index = std::stoi(text.substr(0, slash));
           shard.count = std::stoi(text.substr(slash + 1));
         },
         "do one of N equal shares of the work; prospect merge joins the parts that come of it")
      ->type_name("I/N")
      ->check(PartOfParts());
  app.parse_complete_callback([&app, &shard] { shard.asked = Given(app, HasWeight); });
}

std::string ShardDefect(const ShardOptions& shard, const ReportOptions& report) {
  if (!shard.given() || (!report.json.empty() && report.json != "-")) return "";
  return "--shard writes a part for prospect merge: say with --json FILE where";
}

}  // namespace prospect::cli

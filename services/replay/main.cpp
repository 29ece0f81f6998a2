// prospect-replay: plays a log of the bus for people to look at, rebuilds searches from one, and
// repeats a worker's searches from its journal.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "base/json_file.h"
#include "base/run_main.h"
#include "services/binding/search_table.h"
#include "services/common/common_options.h"
#include "services/from_log/event_log.h"
#include "services/replay/bus_replay.h"
#include "services/replay/journal_replay.h"
#include "services/replay/log_player.h"

namespace {

using namespace prospect;
using namespace prospect::services;
using nlohmann::json;

struct Options {
  std::string log, tables, journal, json_file;
};

void WriteTable(const std::string& folder, const ReplayedSearch& replayed) {
  std::filesystem::create_directories(folder);
  const std::string path =
      folder + "/" + std::to_string(replayed.search->root().search_id) + ".txt";
  prospect::base::WriteFile(path, TableText(replayed.search->search()));
}

json ReplayBus(const Options& options) {
  json searches = json::array();
  for (const auto& replayed : ReplayBusLog(options.log)) {
    const auto& search = replayed.search->search();
    const std::int64_t id = replayed.search->root().search_id;
    const std::string table = base::HexText(TableHash(search));
    std::printf("search %" PRId64 ": %" PRId64 " rollouts, %" PRId64 " evaluations, table %s; %s\n",
                id, search.total_rollouts(), search.known_evaluations(), table.c_str(),
                Summary(search.BestPlan(), replayed.task).c_str());
    searches.push_back({{"search_id", id},
                        {"rollouts", search.total_rollouts()},
                        {"evaluations", search.known_evaluations()},
                        {"replies", replayed.replies},
                        {"statistics", replayed.statistics},
                        {"table", table}});
    if (!options.tables.empty()) WriteTable(options.tables, replayed);
  }
  if (!options.json_file.empty())
    prospect::base::WriteJsonFile(options.json_file, {{"searches", searches}});
  return searches;
}

int ReplayWorker(const Options& options) {
  const JournalReplay replay = ReplayJournal(options.journal);
  std::printf("%" PRId64 " searches, %" PRId64 " messages heard, %" PRId64
              " paths selected in %" PRId64 " steps, %" PRId64 " messages of rows: %" PRId64
              " differences\n",
              replay.searches, replay.heard, replay.selections, replay.advances, replay.sent,
              replay.differences);
  if (!options.json_file.empty()) {
    prospect::base::WriteJsonFile(options.json_file, {{"searches", replay.searches},
                                                      {"heard", replay.heard},
                                                      {"advances", replay.advances},
                                                      {"selections", replay.selections},
                                                      {"sent", replay.sent},
                                                      {"differences", replay.differences},
                                                      {"table", base::HexText(replay.table)}});
  }
  if (replay.differences == 0) return kExitSuccess;
  std::fprintf(stderr, "first: %s\n", replay.first_difference.c_str());
  return kExitTolerance;
}

int Play(const CommonOptions& common, PlayOptions options) {
  ApplyCommonOptions(common, "replay");
  if (!common.bus.empty()) options.bus = common.bus;
  EventLog{options.log};  // a file that is none is named before anything else is said
  std::fprintf(stderr, "Playing on another bus: ./prospect spy --bus '%s'\n", options.bus.c_str());
  const PlayResult result = PlayLog(options);
  std::printf("%" PRId64 " messages played", result.played);
  if (result.commands_left_out > 0)
    std::printf(", %" PRId64 " commands left out (--with-commands plays them, too)",
                result.commands_left_out);
  if (result.damaged > 0) std::printf(", %" PRId64 " damaged places skipped", result.damaged);
  std::printf("\n");
  return result.interrupted ? kExitInterrupted : kExitSuccess;
}

CLI::App* AddPlay(CLI::App& app, CommonOptions& common, PlayOptions& options) {
  CLI::App* play = app.add_subcommand(
      "play", "play a log onto a bus of its own, without commands: nothing moves");
  AddCommonOptions(*play, common);
  play->add_option("log", options.log, "what lcm-logger wrote")->required();
  play->add_option("--speed", options.speed, "times as fast as it was recorded")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  play->add_flag("--with-commands", options.with_commands,
                 "ACTION_COMMAND and SIM_COMMAND, too: a robot on that bus obeys them");
  return play;
}

int Run(int argc, char** argv) {
  CLI::App app("Recordings: played, and searched again");
  app.require_subcommand(1);
  Options options;
  CommonOptions common;
  PlayOptions play_options;
  const CLI::App* play = AddPlay(app, common, play_options);
  CLI::App* bus = app.add_subcommand("bus", "rebuild evaluations and rows from a log of the bus");
  bus->add_option("log", options.log, "what lcm-logger wrote")->required();
  bus->add_option("--tables", options.tables, "write each search's table into this folder");
  CLI::App* journal = app.add_subcommand("journal", "repeat a worker's searches step by step");
  journal->add_option("journal", options.journal, "what prospect-worker --journal wrote")
      ->required();
  for (CLI::App* command : {bus, journal})
    command->add_option("--json", options.json_file, "write the figures to this file, too");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  if (*play) return Play(common, play_options);
  if (*journal) return ReplayWorker(options);
  ReplayBus(options);
  return kExitSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}

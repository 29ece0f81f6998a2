#include "services/replay/commands.h"

#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/exit_codes.h"
#include "base/hash.h"
#include "base/quiet.h"
#include "cli/installation.h"
#include "cli/report_file.h"
#include "services/binding/search_table.h"
#include "services/common/common_options.h"
#include "services/from_log/event_log.h"
#include "services/replay/bus_replay.h"
#include "services/replay/journal_replay.h"
#include "services/replay/log_player.h"

namespace prospect::services {
namespace {

using nlohmann::json;

void WriteTable(const std::string& folder, const ReplayedSearch& replayed) {
  std::filesystem::create_directories(folder);
  const std::string path =
      folder + "/" + std::to_string(replayed.search->root().search_id) + ".txt";
  base::WriteFile(path, TableText(replayed.search->search()));
}

void PrintSearch(const ReplayedSearch& replayed) {
  const auto& search = replayed.search->search();
  std::printf("search %" PRId64 ": %" PRId64 " rollouts, %" PRId64 " evaluations, table %s; %s\n",
              replayed.search->root().search_id, search.total_rollouts(),
              search.known_evaluations(), base::HexText(TableHash(search)).c_str(),
              Summary(search.BestPlan(), replayed.task).c_str());
}

json RowOf(const ReplayedSearch& replayed) {
  const auto& search = replayed.search->search();
  return {{"search_id", replayed.search->root().search_id},
          {"rollouts", search.total_rollouts()},
          {"evaluations", search.known_evaluations()},
          {"replies", replayed.replies},
          {"statistics", replayed.statistics},
          {"table", base::HexText(TableHash(search))}};
}

void Print(const JournalReplay& replay) {
  std::printf("%" PRId64 " searches, %" PRId64 " messages heard, %" PRId64
              " paths selected in %" PRId64 " steps, %" PRId64 " messages of rows: %" PRId64
              " differences\n",
              replay.searches, replay.heard, replay.selections, replay.advances, replay.sent,
              replay.differences);
}

void Print(const PlayResult& result) {
  std::printf("%" PRId64 " messages played", result.played);
  if (result.commands_left_out > 0)
    std::printf(", %" PRId64 " commands left out (--with-commands plays them, too)",
                result.commands_left_out);
  if (result.damaged > 0) std::printf(", %" PRId64 " damaged places skipped", result.damaged);
  std::printf("\n");
}

}  // namespace

int RunPlay(const cli::ReplayOptions& options) {
  ApplyCommonOptions(CommonOptions(options.bus), "replay");
  PlayOptions play;
  play.log = options.log;
  if (!options.bus.bus.empty()) play.bus = options.bus.bus;
  play.speed = options.speed;
  play.with_commands = options.with_commands;
  EventLog{play.log};  // a file that is none is named before anything else is said
  if (!base::Quiet())
    std::fprintf(stderr, "Playing on another bus: %s --bus '%s'\n", cli::Typed("spy").c_str(),
                 play.bus.c_str());
  const PlayResult result = PlayLog(play);
  if (!base::Quiet()) Print(result);
  return result.interrupted ? kExitInterrupted : kExitSuccess;
}

int RunRebuildBus(const cli::RebuildBusOptions& options) {
  json searches = json::array();
  for (const auto& replayed : ReplayBusLog(options.log)) {
    if (options.report.talks()) PrintSearch(replayed);
    searches.push_back(RowOf(replayed));
    if (!options.tables.empty()) WriteTable(options.tables, replayed);
  }
  cli::WriteReport(options.report, {{"searches", searches}});
  return kExitSuccess;
}

int RunRebuildJournal(const cli::RebuildJournalOptions& options) {
  const JournalReplay replay = ReplayJournal(options.journal);
  if (options.report.talks()) Print(replay);
  cli::WriteReport(options.report, {{"searches", replay.searches},
                                    {"heard", replay.heard},
                                    {"advances", replay.advances},
                                    {"selections", replay.selections},
                                    {"sent", replay.sent},
                                    {"differences", replay.differences},
                                    {"table", base::HexText(replay.table)}});
  if (replay.differences == 0) return kExitSuccess;
  std::fprintf(stderr, "first: %s\n", replay.first_difference.c_str());
  return kExitTolerance;
}

}  // namespace prospect::services

// prospect-executive: one episode against services already up: look, search, act, look again; then
// tell what happened. Or many with random plans, for training.

#include <spdlog/spdlog.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "agent/explanation_text.h"
#include "base/atomic_file.h"
#include "base/lock.h"
#include "base/run_main.h"
#include "cli/report_file.h"
#include "report/episode_report.h"
#include "report/episode_video.h"
#include "report/explanation_page.h"
#include "report/explanation_pictures.h"
#include "report/plan_picture.h"
#include "services/common/common_options.h"
#include "services/common/signals.h"
#include "services/executive/bus_episode.h"
#include "services/executive/command_line.h"
#include "services/executive/conversation.h"
#include "services/executive/options.h"
#include "services/executive/policy.h"
#include "services/executive/trial_loop.h"

namespace {

using namespace prospect;
using namespace prospect::report;
using namespace prospect::services;
using prospect::agent::EpisodeRecord;

ExitCode CodeOf(const EpisodeRecord& record) {
  if (record.outcome == "solved" || record.outcome == "explained") return kExitSuccess;
  return record.outcome == "refused" ? kExitRefusal : kExitTaskFailure;
}

void WriteExplanation(const EpisodeRecord& record, const std::string& out) {
  if (!record.explanation) return;
  prospect::base::WriteFile(out + "/explain.html", ExplanationPage(*record.explanation));
  WriteExplanationPictures(*record.explanation, out);
}

void WriteFiles(const EpisodeRecord& record, const std::string& out, ExitCode code) {
  if (out.empty()) return;
  try {
    prospect::base::WriteFile(out + "/result.json", ResultJson(record, code));
    if (record.first.empty()) return;  // it ended before the camera looked
    WriteExplanation(record, out);
    if (record.outcome == "explained") return;  // nothing was carried out
    WritePlanPicture(record, out + "/plan.png");
    WriteEpisodeVideo(record, out + "/episode.mp4");
  } catch (const std::exception& error) {
    throw ExitError(kExitDisk, error.what());
  }
}

void Tell(const EpisodeRecord& record, const ExecutiveCall& call, ExitCode code) {
  if (!call.report.talks()) {
    // Files say it all.
  } else if (call.options.explain_only && record.explanation) {
    std::cout << ExplanationText(*record.explanation) << std::flush;
  } else if (!record.first.empty()) {
    std::cout << PlanTable(record) << std::flush;
  }
  cli::WriteReport(call.report, ResultJson(record, code));
  WriteFiles(record, call.options.out, code);
}

// As far as it came, so that result.json is never that of another episode.
[[noreturn]] void EndStopped(BusEpisode& episode, const ExecutiveCall& call,
                             const ExitError& error) {
  try {
    Tell(episode.Stopped(error.what()), call, error.code());
  } catch (const std::exception& another) {
    spdlog::error("{}", another.what());
  }
  throw error;
}

// Whatever ends an episode, its files are written and the exit status is a documented one.
int RunEpisode(Conversation& talk, const ExecutiveCall& call) {
  const bool talks = call.report.talks();
  BusEpisode episode(talk, call.options, [talks](const std::string& line) {
    if (talks) std::cout << line << std::endl;
  });
  EpisodeRecord record;
  try {
    record = episode.Run();
  } catch (const ExitError& error) {
    EndStopped(episode, call, error);
  } catch (const std::exception& error) {
    EndStopped(episode, call, ExitError(kExitTaskFailure, error.what()));
  }
  Tell(record, call, CodeOf(record));
  return CodeOf(record);
}

int CollectTrials(Conversation& talk, const ExecutiveCall& call) {
  const TrialCounts counts = RunTrials(talk, call);
  if (call.report.talks()) std::cout << counts.Table() << std::flush;
  cli::WriteReport(call.report, counts.ToJson());
  return kExitSuccess;
}

int Run(int argc, char** argv) {
  ExecutiveCall call;
  if (const auto end = ParseExecutive(argc, argv, &call)) return *end;
  const ExecutiveOptions& options = call.options;
  ApplyCommonOptions(call.common, "executive");
  std::optional<prospect::base::Lock> own;  // two episodes would mix their files
  if (!options.out.empty()) own = prospect::base::LockFolder(options.out);

  Bus bus(call.common.bus);
  Conversation talk(bus);
  talk.monitor().RequireOwnBus();
  return call.episodes > 0 ? CollectTrials(talk, call) : RunEpisode(talk, call);
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}

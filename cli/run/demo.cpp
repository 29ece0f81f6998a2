// demo: one episode, or predictions of gestures, with everything started for it.

#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "base/child_process.h"
#include "base/exit_error.h"
#include "cli/installation.h"
#include "cli/options/task.h"
#include "cli/run/carriers.h"
#include "cli/run/executive.h"
#include "cli/run/own_deployment.h"
#include "cli/run/processes.h"
#include "cli/run/results.h"
#include "cli/run/setting.h"
#include "cli/run/starting.h"
#include "cli/table.h"

namespace prospect::cli {
namespace {

using std::chrono::seconds;

// lcm-logger beside an episode. It ends before it is told to when it cannot write.
class Recorder {
 public:
  Recorder(const std::string& bus, const std::string& file, const std::string& log)
      : file_(file), log_(log), process_(Logger(bus, file, log)) {}
  ~Recorder() { process_.End(seconds(5)); }

  /// `status`, or kExitDisk when the recording is cut short, which is told.
  int Checked(int status) {
    if (process_.Running()) return status;
    std::string why = LastLine(TextOf(log_));
    if (why.empty()) why = "lcm-logger has ended";
    std::fprintf(stderr, "prospect: %s is cut short: %s\n", file_.c_str(), why.c_str());
    return kExitDisk;
  }

 private:
  static base::ChildProcess Logger(const std::string& bus, const std::string& file,
                                   const std::string& log) {
    const base::Descriptor output = base::OpenOutput(log);
    base::ChildOptions options;
    options.command = {"/usr/bin/env", "lcm-logger", "-q", "-f", "--lcm-url=" + bus, file};
    options.out = options.err = output.get();
    options.detached = true;  // Ctrl-C is for the episode, which is recorded to its end
    return base::ChildProcess(options);
  }

  std::string file_, log_;
  base::ChildProcess process_;
};

int Episode(const DemoOptions& options, const Invocation& invocation, const Words& world,
            const std::string& out, const OwnDeployment& own) {
  Recorder recorder(own.bus(), out + "/episode.lcmlog", out + "/logs/logger.log");
  const int workers = WorkersOf(options.episode.workers, options.episode.task);
  const int status = RunExecutive(invocation, {own.bus(), out, workers, world});
  return recorder.Checked(own.Explained(status));
}

// At most five minutes.
int StatusOf(base::ChildProcess* process) {
  const std::optional<int> status = process->Wait(seconds(300));
  if (status) return *status;
  process->End(seconds(5));
  return kExitTimeout;
}

base::ChildProcess Started(Words command, int output) {
  base::ChildOptions options;
  options.command = std::move(command);
  options.out = options.err = output;
  options.death_signal = SIGTERM;
  return base::ChildProcess(options);
}

// The simulated surgeon makes half a stitch (G1 G5 G2 G3 G6 G4); from the picture on which G3
// begins the networks say what comes.
int Gestures(const DemoOptions& options, const std::string& out, const OwnDeployment& own) {
  const std::string seed = std::to_string(options.episode.seed);
  Words predict = StartOf(*FindCommand("predict"));
  predict.insert(predict.end(), {"--bus", own.bus(), "--out", out, "--seed", seed, "--segment", "3",
                                 "--truth", "60"});
  base::ChildProcess predicting = Started(predict, -1);
  int status = own.services().Await("model=1,simulator=1,predict=1");
  const base::Descriptor log = base::OpenOutput(out + "/logs/executive.log");
  base::ChildProcess acting = Started({PathOf("prospect-executive"), "--bus", own.bus(), "--seed",
                                       seed, "--policy", "plan:0,4,1,2,5,3"},
                                      log.get());
  StatusOf(&acting);
  if (const int predicted = StatusOf(&predicting); predicted != 0) status = predicted;
  return own.Explained(status);
}

void TellResults(const DemoOptions& options, const std::string& out, int status,
                 std::time_t start) {
  if (!options.episode.report.talks()) return;
  TellFiles(
      out,
      {"futures.png", "explain.html", "plan.png", "episode.mp4", "episode.lcmlog", "result.json"},
      start);
  const auto& world = TaskOf(options.episode.task).simulator;
  if (!world || !world->scene_file || status == kExitRefusal) return;
  if (!IsNew(out + "/episode.mp4", start)) return;
  // The robot's camera is small; people see an arm better at another size and from the side.
  const std::string& scene = options.episode.scene.scene_file;
  std::fprintf(
      stderr,
      "Seen from the side (it takes a while): %s --episode %s/result.json --video %s/view.mp4%s\n",
      Typed("view").c_str(), out.c_str(), out.c_str(),
      scene.empty() ? "" : (" --scene-file " + scene).c_str());
}

}  // namespace

Words ProgramsOf(const DemoOptions& options) {
  Words programs = DeployedPrograms();
  if (TaskOf(options.episode.task).only_predicted)
    programs.push_back(FindCommand("predict")->program);
  return programs;
}

int Run(const DemoOptions& options, const Invocation& invocation) {
  const std::time_t start = std::time(nullptr);
  const EpisodeOptions& episode = options.episode;
  const bool gestures = TaskOf(episode.task).only_predicted;
  const bool searches = options.acting.policy == "search";
  const std::string out =
      episode.out.empty() ? UsualFolder(episode.task, episode.seed) : episode.out;
  const Starting starting = StartingOf(episode, options.start, episode.task, searches);
  const Words world = WorldArguments(episode.scene, episode.task);
  OwnDeployment own(episode.bus.bus);
  const ResultsFolder results(out);
  own.Start(ArgumentsOf(starting, results.logs()));
  const int status =
      gestures ? Gestures(options, out, own) : Episode(options, invocation, world, out, own);
  TellResults(options, out, status, start);
  return status;
}

}  // namespace prospect::cli

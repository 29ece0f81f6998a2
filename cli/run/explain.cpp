// explain: one search and its reasons, of the scene that is up as it stands, unless a seed is
// given; with nothing up, of one that is started for it.

#include <ctime>

#include "base/exit_error.h"
#include "cli/installation.h"
#include "cli/options/task.h"
#include "cli/run/bus_place.h"
#include "cli/run/carriers.h"
#include "cli/run/executive.h"
#include "cli/run/own_deployment.h"
#include "cli/run/results.h"
#include "cli/run/setting.h"
#include "cli/run/starting.h"
#include "cli/run/wishes.h"

namespace prospect::cli {
namespace {

// What was chosen when the deployment was started.
void RefuseStartOptions(const CLI::App& app) {
  for (const char* name : {"--factor", "--strength", "--open"}) {
    if (app.count(name) > 0)
      throw ExitError(kExitUsage, name + (" is an option of " + Typed("up")) +
                                      ": it is chosen when a deployment is started");
  }
}

int ExplainWhatIsUp(const ExplainOptions& options, const Invocation& invocation, const UpFacts& up,
                    ExecutiveCall call) {
  RefuseStartOptions(invocation.app);
  RequireScene(options.episode.scene, up.task_wish());
  const Words world = WorldArguments(options.episode.scene, up.task_wish());
  RequireRoute(call.bus);
  call.workers = options.episode.workers > 0 ? options.episode.workers : up.workers;
  call.more.insert(call.more.end(), world.begin(), world.end());
  if (options.episode.task.empty() && !up.task_file.empty())
    call.more.insert(call.more.end(), {"--task", up.task_file});
  if (invocation.app.count("--seed") == 0 && options.reset) call.more.push_back("--no-reset");
  return RunExecutive(invocation, call);
}

// What stands before a robot is not explained by another scene: services that another machine or
// user has up are found by what they say.
int ExplainWhatIsHeard(const ExplainOptions& options, const Invocation& invocation,
                       ExecutiveCall call) {
  RequireRoute(call.bus);
  const int heard = RunToEnd({PathOf("prospect-bus"), "heard", "--bus", call.bus});
  if (heard != 0) return heard;
  call.workers = options.episode.workers > 0 ? options.episode.workers : kUsualWorkers;
  return RunExecutive(invocation, call);
}

int ExplainAlone(const ExplainOptions& options, const Invocation& invocation, ExecutiveCall call) {
  const EpisodeOptions& episode = options.episode;
  const std::string task = episode.task.empty() ? DefaultTask() : episode.task;
  RequireScene(episode.scene, task);
  if (!TaskOf(task).simulator)
    throw ExitError(kExitServiceLost,
                    "nothing is up, and " + TaskOf(task).spec.name +
                        " has no built-in simulator: " + Typed("up --no-simulator --task ") + task +
                        ", and a robot in its place");
  const Starting starting = StartingOf(episode, options.start, task, /*searches=*/true);
  const Words world = WorldArguments(episode.scene, task);
  OwnDeployment own(episode.bus.bus);
  const ResultsFolder results(call.out);
  own.Start(ArgumentsOf(starting, results.logs()));
  call.bus = own.bus();
  call.workers = starting.workers;
  call.more.insert(call.more.end(), world.begin(), world.end());
  return own.Explained(RunExecutive(invocation, call));
}

}  // namespace

Words ProgramsOf(const ExplainOptions&) { return DeployedPrograms(); }

int Run(const ExplainOptions& options, const Invocation& invocation) {
  const std::time_t start = std::time(nullptr);
  const EpisodeOptions& episode = options.episode;
  ExecutiveCall call;
  call.bus = BusOf(episode.bus.bus);
  call.out = episode.out.empty() ? "out/explain" : episode.out;
  call.more = {"--explain-only"};
  TakeKey(episode.bus.key);
  const auto up = Deployment(call.bus).Join(WishesOf(episode, options.start.weights));
  const int status = up              ? ExplainWhatIsUp(options, invocation, *up, call)
                     : options.reset ? ExplainAlone(options, invocation, call)
                                     : ExplainWhatIsHeard(options, invocation, call);
  if (episode.report.talks())
    TellFiles(call.out,
              {"explain.html", "chosen.png", "alternative-1.png", "alternative-2.png",
               "alternative-3.png", "alternative-4.png", "alternative-5.png", "what-if.png",
               "result.json"},
              start);
  return status;
}

}  // namespace prospect::cli

// up and run: services that stay, and an episode against them.

#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <thread>

#include "base/exit_error.h"
#include "cli/installation.h"
#include "cli/options/task.h"
#include "cli/run/bus_place.h"
#include "cli/run/carriers.h"
#include "cli/run/executive.h"
#include "cli/run/facts.h"
#include "cli/run/processes.h"
#include "cli/run/results.h"
#include "cli/run/setting.h"
#include "cli/run/starting.h"
#include "cli/run/wishes.h"

namespace prospect::cli {
namespace {

std::string VideoFile(const std::string& path) {
  std::error_code error;
  const auto whole = std::filesystem::canonical(path, error);
  if (error) throw ExitError(kExitDataFile, "no video at " + path);
  return whole.string();
}

// What the supervisor is told besides what every deployment has.
Words ArgumentsOf(const UpOptions& options, Starting starting) {
  Words first;
  if (!options.simulator) first.push_back("--no-simulator");
  if (options.console) first.push_back("--console");
  if (options.control) first.push_back("--control");
  if (!options.video.empty()) {
    first.push_back("--player");
    starting.scene = {"--video", VideoFile(options.video)};
    if (!options.transcription.empty())
      starting.scene.insert(starting.scene.end(),
                            {"--transcription", VideoFile(options.transcription)});
  }
  const Words rest = ArgumentsOf(starting, "");
  first.insert(first.end(), rest.begin(), rest.end());
  return first;
}

std::string ServicesOf(const UpOptions& options, int workers) {
  std::string services = "model=1";
  if (workers > 0) services += ",worker=" + std::to_string(workers);
  return options.simulator ? services + ",simulator=1" : services;
}

// Where the page is. The console writes it once it serves.
std::string ConsoleOf(const Deployment& deployment) {
  const std::string file = deployment.Folder() + "/console.url";
  for (int turn = 0; turn < 100; ++turn) {
    const std::string url = LastLine(TextOf(file));
    if (!url.empty()) return url;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return "none; see " + deployment.Folder() + "/logs/console.log";
}

int GiveUp(const Deployment& deployment, int status) {
  const int given_up = deployment.TellGivenUp();
  deployment.Stop(/*silently=*/true);
  return given_up == 0 ? status : given_up;
}

}  // namespace

Words ProgramsOf(const UpOptions& options) {
  Words programs = DeployedPrograms();
  if (!options.video.empty()) programs.push_back("prospect-video");
  if (options.console) programs.push_back("prospect-console");
  return programs;
}

int Run(const UpOptions& options, const Invocation&) {
  EpisodeOptions episode;
  episode.bus = options.bus;
  episode.scene = options.scene;
  episode.workers = std::max(options.workers, 0);
  const Starting starting = StartingOf(episode, options.start, options.task, /*searches=*/true);
  WorldArguments(options.scene, options.task);  // refuses a bad scene file before anything starts
  const Words arguments = ArgumentsOf(options, starting);
  const Deployment deployment(BusOf(options.bus.bus));
  RequireRoute(deployment.bus());
  if (options.foreground) return Become(deployment.StartCommand(arguments));
  deployment.Start(arguments);
  const auto up = deployment.Join();
  if (!up)
    throw ExitError(kExitServiceLost, "what was just started has ended: see " +
                                          deployment.Folder() + "/logs/supervisor.log");
  const int status = deployment.Await(ServicesOf(options, starting.workers));
  if (status != 0) return GiveUp(deployment, status);
  const std::string console = options.console ? ConsoleOf(deployment) : "";
  if (options.report.talks() && options.console)
    std::fprintf(stderr, "The console: %s\n", console.c_str());
  if (options.report.talks())
    std::fprintf(stderr, "Up: %s, %s on %s; logs in %s. Next: %s; %s; %s\n", starting.task.c_str(),
                 Count(starting.workers, "worker").c_str(), deployment.bus().c_str(),
                 up->logs.c_str(), Typed("run --seed 2000000").c_str(), Typed("spy").c_str(),
                 Typed("down").c_str());
  Tell(options.report, {{"task", starting.task},
                        {"workers", starting.workers},
                        {"bus", deployment.bus()},
                        {"key", up->key},
                        {"logs", up->logs},
                        {"console", console}});
  return status;
}

Words ProgramsOf(const RunOptions& options) {
  Words programs{"prospect-executive", "prospect-supervisor", "prospect-bus"};
  if (!options.episode.scene.scene_file.empty()) programs.push_back("prospect-simulator");
  return programs;
}

int Run(const RunOptions& options, const Invocation& invocation) {
  const std::time_t start = std::time(nullptr);
  const EpisodeOptions& episode = options.episode;
  TakeKey(episode.bus.key);
  const std::string bus = BusOf(episode.bus.bus);
  const auto up = Deployment(bus).Join(WishesOf(episode, options.weights));
  // Services that another machine or user has up are found by what they say.
  const std::string task = !episode.task.empty() ? episode.task
                           : up                  ? up->task_wish()
                                                 : DefaultTask();
  RequireScene(episode.scene, task);
  Words more = WorldArguments(episode.scene, task);
  if (episode.task.empty() && up && !up->task_file.empty())
    more.insert(more.end(), {"--task", up->task_file});
  RequireRoute(bus);
  if (!up) {
    const int heard = RunToEnd({PathOf("prospect-bus"), "heard", "--bus", bus});
    if (heard != 0) return heard;
  }
  const int workers = episode.workers > 0 ? episode.workers : up ? up->workers : kUsualWorkers;
  const std::string out = episode.out.empty() ? UsualFolder(task, episode.seed) : episode.out;
  const int status = RunExecutive(invocation, {bus, out, workers, more});
  if (episode.report.talks())
    TellFiles(out, {"plan.png", "explain.html", "episode.mp4", "result.json", "trials.json"},
              start);
  return status;
}

}  // namespace prospect::cli

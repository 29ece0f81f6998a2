// prospect-supervisor: keeps a deployment running. SIGTERM or Ctrl-C stops all of it; after SIGHUP
// there are as many workers as STATE/workers says.

#include <signal.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "services/common/common_options.h"
#include "services/common/run_main.h"
#include "services/supervisor/supervisor.h"

namespace {

using namespace prospect::services;

struct Options {
  CommonOptions common;
  DeploymentSpec deployment;
  std::string state, logs;
  int workers = 2;
  bool no_simulator = false;
};

void AddOptions(CLI::App& app, Options& options) {
  AddCommonOptions(app, options.common);
  app.add_option("--task", options.deployment.task, "world to simulate")->required();
  app.add_option("--weights", options.deployment.weights, "of the model server")->required();
  app.add_option("--workers", options.workers, "planner workers")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("--no-simulator", options.no_simulator, "a robot is in the simulator's place");
  app.add_flag("--player", options.deployment.player,
               "a video is in the simulator's place: prospect-player, with what comes after --");
  app.add_option("--state", options.state, "folder for services.json and the wish file workers")
      ->required();
  app.add_option("--logs", options.logs, "folder for a log a service")->required();
  app.add_option("scene", options.deployment.scene, "after --: further options of the simulator");
}

// The number of workers wished for, or `otherwise`.
int WishedWorkers(const std::string& state, int otherwise) {
  std::ifstream in(state + "/workers");
  int workers = otherwise;
  return in >> workers ? workers : otherwise;
}

sigset_t BlockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

int Supervise(const Options& options, const sigset_t& signals) {
  Supervisor supervisor(options.deployment, options.workers, options.state, options.logs);
  while (true) {
    const timespec turn{0, 50'000'000};
    const int signal = sigtimedwait(&signals, nullptr, &turn);
    if (signal == SIGINT || signal == SIGTERM) break;
    if (signal == SIGHUP) supervisor.Scale(WishedWorkers(options.state, options.workers));
    supervisor.Turn();
  }
  spdlog::info("stopping");
  supervisor.Stop();
  std::filesystem::remove(options.state + "/services.json");
  return kExitSuccess;
}

int Run(int argc, char** argv) {
  CLI::App app("Keeps the processes of a deployment running");
  Options options;
  AddOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  ApplyCommonOptions(options.common, "supervisor");
  options.deployment.bus = options.common.bus;
  options.deployment.chaos = options.common.chaos;
  options.deployment.simulator = !options.no_simulator;
  options.deployment.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  return Supervise(options, BlockSignals());
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}

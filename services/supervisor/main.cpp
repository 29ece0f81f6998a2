// prospect-supervisor: keeps a deployment running. SIGTERM, Ctrl-C or the end of its terminal stops
// all of it. `prospect-supervisor stop`, `scale`, `join`, ... ask one that runs (commands.h).

#include <poll.h>
#include <signal.h>
#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/spdlog.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/run_main.h"
#include "cli/installation.h"
#include "services/common/common_options.h"
#include "services/common/ids.h"
#include "services/common/log.h"
#include "services/supervisor/background.h"
#include "services/supervisor/commands.h"
#include "services/supervisor/facts.h"
#include "services/supervisor/pidfd.h"
#include "services/supervisor/state_folder.h"
#include "services/supervisor/supervisor.h"

namespace {

using namespace prospect;
using namespace prospect::services;

struct Options {
  CommonOptions common;
  DeploymentSpec deployment;
  std::string state, logs;
  int workers = 2;
  int lives_with = 0;
  bool no_simulator = false;
  bool open = false;
  bool background = false;
};

void AddOptions(CLI::App& app, Options& options) {
  cli::DefineProcess(app, options.common);
  app.add_option("--task", options.deployment.task, "its name: the world to simulate")->required();
  app.add_option("--task-file", options.deployment.task_file,
                 "of a task that is not installed, for whoever joins");
  app.add_option("--weights", options.deployment.weights, "of the model server")->required();
  app.add_option("--workers", options.workers, "planner workers")
      ->check(CLI::Range(0, kMostWorkers))
      ->capture_default_str();
  app.add_flag("--no-simulator", options.no_simulator, "a robot is in the simulator's place");
  app.add_flag(
      "--player", options.deployment.player,
      "a video is in the simulator's place: prospect-video play, with what comes after --");
  app.add_flag("--console", options.deployment.console, "with a page in the browser");
  app.add_flag("--control", options.deployment.control, "whose buttons may be pressed");
  app.add_option("--state", options.state, "folder for services.json and key; empty: the bus's");
  app.add_option("--logs", options.logs, "folder for a log a service; empty: STATE/logs");
  app.add_flag("--open", options.open, "no key: whoever can send on the bus is obeyed");
  app.add_flag("--background", options.background,
               "return once everything is started, and log to LOGS/supervisor.log");
  app.add_option("--lives-with", options.lives_with,
                 "stop when this process ends, and remove the state folder")
      ->check(CLI::PositiveNumber);
  app.add_option("scene", options.deployment.scene, "after --: further options of the simulator");
}

void LogToFile(const std::string& logs) {
  const std::string path = logs + "/supervisor.log";
  try {
    const auto file = std::make_shared<spdlog::sinks::rotating_file_sink_mt>(
        path, ServiceLog::kMaxBytes, 1, true);
    file->set_pattern(kLogPattern);
    spdlog::default_logger()->sinks() = {file};
  } catch (const spdlog::spdlog_ex& error) {
    throw ExitError(kExitDisk, "cannot write " + path + ": " + error.what());
  }
}

// Signals by a descriptor, so that one poll() waits for them and for the services' output.
base::Descriptor OpenSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD, ScaleSignal()}) {
    struct sigaction now {};
    // nohup has it ignored.
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN && signal == SIGHUP)
      continue;
    sigaddset(&signals, signal);
  }
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  base::Descriptor opened(signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK));
  if (!opened) throw std::runtime_error(std::string("no signals: ") + std::strerror(errno));
  return opened;
}

// Takes the signals that have come. @return whether to go on
bool TakeSignals(const base::Descriptor& signals, Supervisor* supervisor) {
  signalfd_siginfo got{};
  bool go_on = true;
  while (read(signals.get(), &got, sizeof got) == sizeof got) {
    const int signal = static_cast<int>(got.ssi_signo);
    if (signal == ScaleSignal() && got.ssi_code == SI_QUEUE) supervisor->Scale(got.ssi_int);
    if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) go_on = false;
  }
  return go_on;
}

// Until a signal, or the end of the process `companion` watches.
void KeepRunning(Supervisor* supervisor, const base::Descriptor& signals,
                 const base::Descriptor& companion) {
  constexpr int kTurnMs = 50;
  while (true) {
    std::vector<pollfd> awaited{{signals.get(), POLLIN, 0}, {companion.get(), POLLIN, 0}};
    for (const int output : supervisor->Outputs()) awaited.push_back({output, POLLIN, 0});
    poll(awaited.data(), awaited.size(), kTurnMs);
    if (awaited[1].revents != 0) return;
    try {
      if (!TakeSignals(signals, supervisor)) return;
      supervisor->Turn();
    } catch (const std::exception& error) {
      spdlog::error("{}; the services go on", error.what());
    }
  }
}

base::Descriptor Watch(int process) {
  base::Descriptor companion(process > 0 ? pidfd_open(process, 0) : -1);
  if (process > 0 && !companion) {
    throw ExitError(kExitUsage,
                    "--lives-with " + std::to_string(process) + ": there is no such process");
  }
  return companion;
}

StateFolder TakeState(const std::string& path) {
  StateFolder state(path, StateFolder::IfAbsent::kMake);
  const bool used = state.was_used();
  if (!state.Lock()) {
    throw ExitError(kExitBusInUse, "a deployment of yours is already up on this bus (pid " +
                                       std::to_string(state.Holder()) + "): " + cli::Typed("down") +
                                       ", or another port with --bus");
  }
  if (used && state.Clear()) spdlog::warn("an earlier deployment crashed; what it left is removed");
  return state;
}

// What lies in the state folder goes with the deployment.
void RequireKeyElsewhere(const Options& options) {
  const std::string& key = options.common.key;
  if (key.empty()) return;
  std::error_code none;
  const auto folder = std::filesystem::absolute(key).parent_path();
  if (std::filesystem::equivalent(folder, options.state, none))
    throw ExitError(kExitUsage, "--key " + key + " lies in the state folder, which is cleared: " +
                                    "keep it elsewhere");
}

// The processes started from here find both in their environment.
void SetIdentity(Options* options, const StateFolder& state) {
  if (DeploymentId() == 0) SetDeploymentId(RandomId());
  setenv("PROSPECT_DEPLOYMENT", std::to_string(DeploymentId()).c_str(), 1);
  std::string& key = options->deployment.key;
  const std::string& given = options->common.key;
  if (options->open) {
    unsetenv("PROSPECT_KEY_FILE");
    return;
  }
  key = given.empty() ? state.MakeKey() : std::filesystem::absolute(given).string();
  setenv("PROSPECT_KEY_FILE", key.c_str(), 1);
}

void TellWhoIsObeyed(const Options& options) {
  const std::string& key = options.deployment.key;
  if (key.empty()) {
    std::fprintf(
        stderr, "Warning: this bus is open (--open): whoever can send on it can move the robot.\n");
  } else if (options.lives_with == 0) {  // nobody can join a deployment of one command
    std::fprintf(stderr, "Only who has this bus's key is heard on it; a robot needs: --key %s\n",
                 key.c_str());
  }
}

int Supervise(Options options, base::Descriptor* ready) {
  const base::Descriptor companion = Watch(options.lives_with);
  RequireKeyElsewhere(options);
  StateFolder state = TakeState(options.state);
  const std::string logs = options.logs.empty() ? state.path() + "/logs" : options.logs;
  SetIdentity(&options, state);
  const base::Descriptor signals = OpenSignals();
  if (options.background) LogToFile(logs);
  Supervisor supervisor(options.deployment, options.workers, state.path(), logs);
  TellWhoIsObeyed(options);
  SayReady(ready);
  KeepRunning(&supervisor, signals, companion);
  spdlog::info("stopping");
  supervisor.Stop();
  if (options.lives_with > 0) state.Remove();
  return kExitSuccess;
}

int Run(int argc, char** argv) {
  if (IsCommand(argc, argv)) return RunCommand(argc, argv);
  CLI::App app("Keeps the processes of a deployment running");
  Options options;
  AddOptions(app, options);
  app.footer("Of one that runs: prospect-supervisor folder|join|stop|scale|given-up --help");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  base::Descriptor ready;
  if (options.background) {
    if (const auto status = GoOnInBackground(&ready)) return *status;
  }
  ApplyCommonOptions(options.common, "supervisor");
  options.deployment.bus = options.common.bus;
  options.deployment.chaos = options.common.chaos;
  options.deployment.weights = WholePath(options.deployment.weights);
  options.deployment.simulator = !options.no_simulator;
  options.deployment.programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  if (options.state.empty()) options.state = StateFolderOf(options.common.bus);
  return Supervise(options, &ready);
}

}  // namespace

int main(int argc, char** argv) {
  return RunMain([&] { return Run(argc, argv); });
}

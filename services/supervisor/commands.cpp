#include "services/supervisor/commands.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>

#include "base/exit_error.h"
#include "cli/installation.h"
#include "services/common/bus_url.h"
#include "services/common/clock.h"
#include "services/supervisor/facts.h"
#include "services/supervisor/pidfd.h"
#include "services/supervisor/state_folder.h"

namespace prospect::services {
namespace {

constexpr int kPoliteMs = 9000;  // the supervisor gives its services five seconds
constexpr int kKilledMs = 3000;
constexpr std::int64_t kFactsMs = 3000;

struct Options {
  std::string bus, state;
  bool is_private = false;
  int workers = 0;
  Wish wish;
};

std::string PathOf(const Options& options) {
  return options.state.empty() ? StateFolderOf(options.bus) : options.state;
}

std::string NothingUp(const Options& options) {
  return "nothing is up on " + (options.state.empty() ? ResolveBusUrl(options.bus) : options.state);
}

// A supervisor that is held by its descriptor, so that its number cannot pass to another process
// before a signal is sent.
class LiveSupervisor {
 public:
  explicit LiveSupervisor(const StateFolder& state) {
    const int holder = state.Holder();
    if (holder == StateFolder::kUnseen) {
      throw ExitError(kExitServiceLost, "the deployment of " + state.path() +
                                            " runs where its processes cannot be seen from here "
                                            "(another container?): ask it there");
    }
    if (holder == StateFolder::kNobody) return;
    process_ = base::Descriptor(pidfd_open(holder, 0));
    if (state.Holder() != holder) process_.Close();  // it ended meanwhile
  }

  bool there() const { return static_cast<bool>(process_); }

  void Send(int signal, int value = 0) const {
    siginfo_t info{};
    info.si_signo = signal;
    info.si_code = SI_QUEUE;
    info.si_pid = getpid();
    info.si_uid = getuid();
    info.si_value.sival_int = value;
    if (pidfd_send_signal(process_.get(), signal, &info, 0) == 0 || errno == ESRCH) return;
    throw ExitError(kExitTaskFailure,
                    std::string("the supervisor cannot be asked: ") + std::strerror(errno));
  }

  bool EndedWithin(int milliseconds) const {
    pollfd awaited{process_.get(), POLLIN, 0};
    const std::int64_t deadline_ms = SteadyMs() + milliseconds;
    while (true) {
      const std::int64_t left_ms = std::max<std::int64_t>(deadline_ms - SteadyMs(), 0);
      const int count = poll(&awaited, 1, static_cast<int>(left_ms));
      if (count > 0) return true;
      if (left_ms == 0 || (count < 0 && errno != EINTR)) return false;
    }
  }

 private:
  base::Descriptor process_;
};

int Folder(const Options& options) {
  const std::string path = options.is_private ? MakePrivateFolder() : PathOf(options);
  std::printf("%s\n", path.c_str());
  return kExitSuccess;
}

int Stop(const Options& options) {
  StateFolder state(PathOf(options), StateFolder::IfAbsent::kAccept);
  const LiveSupervisor supervisor(state);
  if (supervisor.there()) {
    supervisor.Send(SIGTERM);
    if (!supervisor.EndedWithin(kPoliteMs)) {
      supervisor.Send(SIGKILL);  // its services hear of its death
      if (!supervisor.EndedWithin(kKilledMs)) {
        throw ExitError(kExitTaskFailure, "the supervisor of " + state.path() + " does not end");
      }
    }
  }
  const bool left = state.was_used() && state.Lock() && state.Clear();
  const char* crashed = left ? "; what a deployment that had crashed left there is removed" : "";
  if (supervisor.there()) {
    std::fprintf(stderr, "Down.\n");
  } else {
    std::fprintf(stderr, "prospect: %s%s\n", NothingUp(options).c_str(), crashed);
  }
  return kExitSuccess;
}

DeploymentFacts FactsOf(const StateFolder& state) {
  const std::int64_t deadline_ms = SteadyMs() + kFactsMs;
  while (true) {
    if (const auto facts = ReadFacts(state.path() + "/services.json")) return *facts;
    if (SteadyMs() > deadline_ms) {
      throw ExitError(kExitTimeout, "the deployment of " + state.path() +
                                        " does not say what it is: " + cli::Typed("down") +
                                        ", then up");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

int Join(const Options& options) {
  const StateFolder state(PathOf(options), StateFolder::IfAbsent::kAccept);
  if (state.Holder() == StateFolder::kNobody) {
    throw ExitError(kExitServiceLost, NothingUp(options) + ": " + cli::Typed("up"));
  }
  const DeploymentFacts facts = FactsOf(state);
  const std::string contradiction = Contradiction(facts, options.wish);
  if (!contradiction.empty()) throw ExitError(kExitUsage, contradiction);
  std::printf("state=%s\ndeployment=%lld\nkey=%s\ntask=%s\ntask_file=%s\nworkers=%d\nlogs=%s\n",
              state.path().c_str(), static_cast<long long>(facts.deployment), facts.key.c_str(),
              facts.task.c_str(), facts.task_file.c_str(), facts.workers, facts.logs.c_str());
  return kExitSuccess;
}

int Scale(const Options& options) {
  const StateFolder state(PathOf(options), StateFolder::IfAbsent::kAccept);
  const LiveSupervisor supervisor(state);
  if (!supervisor.there()) {
    throw ExitError(kExitServiceLost, NothingUp(options) + ": " + cli::Typed("up"));
  }
  supervisor.Send(ScaleSignal(), options.workers);
  return kExitSuccess;
}

int TellGivenUp(const Options& options) {
  const auto given_up = ReadGivenUp(PathOf(options) + "/services.json");
  for (const GivenUp& service : given_up) {
    std::fprintf(stderr, "prospect: %s ended: %s\n", service.name.c_str(),
                 service.last_words.c_str());
  }
  return given_up.empty() ? kExitSuccess : given_up.front().status;
}

struct Command {
  const char* name;
  const char* help;
  int (*run)(const Options&);
};

constexpr Command kCommands[] = {
    {"folder", "print the state folder", Folder},
    {"join", "print what is up as NAME=VALUE lines", Join},
    {"stop", "stop the deployment", Stop},
    {"scale", "so many planner workers", Scale},
    {"given-up", "say which services were given up and why", TellGivenUp},
};

void AddWishes(CLI::App* join, Wish* wish) {
  join->add_option("--task", wish->task, "refuse another");
  join->add_option("--weights", wish->weights, "refuse others");
  join->add_option("--workers", wish->workers, "refuse fewer");
  join->add_flag("--scene", wish->scene, "refuse a world that cannot change its scene's size");
}

}  // namespace

int ScaleSignal() { return SIGRTMIN; }

bool IsCommand(int argc, char** argv) {
  for (const Command& command : kCommands) {
    if (argc > 1 && std::strcmp(argv[1], command.name) == 0) return true;
  }
  return false;
}

int RunCommand(int argc, char** argv) {
  CLI::App app("Asks a deployment that is up");
  app.require_subcommand(1);
  Options options;
  for (const Command& command : kCommands) {
    CLI::App* added = app.add_subcommand(command.name, command.help);
    added->add_option("--bus", options.bus, "its bus; empty: LCM_DEFAULT_URL, then the default");
    added->add_option("--state", options.state, "its state folder; empty: that of the bus");
  }
  app.get_subcommand("folder")->add_flag("--private", options.is_private,
                                         "make a new one for a deployment of one's own");
  app.get_subcommand("scale")
      ->add_option("workers", options.workers, "how many")
      ->required()
      ->check(CLI::Range(0, kMostWorkers));
  AddWishes(app.get_subcommand("join"), &options.wish);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  for (const Command& command : kCommands) {
    if (app.got_subcommand(command.name)) return command.run(options);
  }
  return kExitUsage;
}

}  // namespace prospect::services

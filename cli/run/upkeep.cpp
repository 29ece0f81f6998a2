// Commands that ask about or of the deployment that is up.

#include <cstdio>

#include "base/exit_error.h"
#include "cli/run/bus_place.h"
#include "cli/run/carriers.h"
#include "cli/run/deployment.h"
#include "cli/run/facts.h"
#include "cli/run/processes.h"
#include "cli/run/setting.h"
#include "cli/table.h"

namespace prospect::cli {
namespace {

void Append(const Words& more, Words* words) {
  words->insert(words->end(), more.begin(), more.end());
}

// The command's program, which joins what is up and takes what was typed.
Words Joining(const std::string& bus, const std::string& key, const Invocation& invocation) {
  TakeKey(key);
  Deployment(bus).Join();
  Words words = StartOf(invocation.command);
  Append(invocation.typed, &words);
  return words;
}

// The programs of a command that joins what is up.
Words ProgramsToJoin(const char* command) {
  return {FindCommand(command)->program, "prospect-supervisor"};
}

// A program that reads what the deployment's supervisor says of its processes.
template <typename Options>
int BecomeBesideServices(const Options& options, const Invocation& invocation) {
  const std::string bus = BusOf(options.bus.bus);
  RequireRoute(bus);
  const std::string folder = Deployment(bus).Folder();
  Words command = Joining(bus, options.bus.key, invocation);
  if (options.services_file.empty())
    Append({"--services-file", folder + "/services.json"}, &command);
  return Become(command);
}

}  // namespace

Words ProgramsOf(const DownOptions&) { return {"prospect-supervisor"}; }

int Run(const DownOptions& options, const Invocation&) {
  const Deployment deployment(BusOf(options.bus));
  const bool was_up = deployment.Join().has_value();
  const int status = deployment.Stop(!options.report.talks());
  if (status == 0) Tell(options.report, {{"bus", deployment.bus()}, {"was_up", was_up}});
  return status;
}

Words ProgramsOf(const KeyOptions&) { return {"prospect-supervisor"}; }

// The path of the key, for a robot: example-robot --key "$(./prospect key)".
int Run(const KeyOptions& options, const Invocation&) {
  const Deployment deployment(BusOf(options.bus));
  const UpFacts up = deployment.Require();
  if (up.key.empty())
    throw ExitError(kExitTaskFailure,
                    "the deployment on " + deployment.bus() + " is open: it has no key");
  if (options.report.talks()) std::printf("%s\n", up.key.c_str());
  Tell(options.report, {{"key", up.key}});
  return kExitSuccess;
}

Words ProgramsOf(const ScaleOptions&) { return {"prospect-bus", "prospect-supervisor"}; }

int Run(const ScaleOptions& options, const Invocation&) {
  const Deployment deployment(BusOf(options.bus));
  deployment.Require();
  const int workers = options.workers();
  if (const int status = deployment.Scale(workers); status != 0) return status;
  const int status = deployment.Await("worker=" + std::to_string(workers));
  if (status != 0) return status;
  if (options.report.talks()) std::fprintf(stderr, "%s.\n", Count(workers, "worker").c_str());
  Tell(options.report, {{"workers", workers}});
  return kExitSuccess;
}

Words ProgramsOf(const StatusOptions&) { return ProgramsToJoin("status"); }

int Run(const StatusOptions& options, const Invocation& invocation) {
  return BecomeBesideServices(options, invocation);
}

Words ProgramsOf(const ConsoleOptions& options) {
  Words programs = ProgramsToJoin("console");
  if (options.control) programs.insert(programs.end(), {"prospect-executive", "prospect-bus"});
  return programs;
}

int Run(const ConsoleOptions& options, const Invocation& invocation) {
  if (!options.log.empty()) {
    Words command = StartOf(invocation.command);
    Append(invocation.typed, &command);
    return Become(command);
  }
  return BecomeBesideServices(options, invocation);
}

Words ProgramsOf(const CheckRobotOptions&) { return ProgramsToJoin("check-robot"); }

int Run(const CheckRobotOptions& options, const Invocation& invocation) {
  return Become(Joining(BusOf(options.bus.bus), options.bus.key, invocation));
}

Words ProgramsOf(const TaskLearnOptions&) { return ProgramsToJoin("task learn"); }

int Run(const TaskLearnOptions& options, const Invocation& invocation) {
  const std::string bus = BusOf(options.bus.bus);
  RequireRoute(bus);
  return Become(Joining(bus, options.bus.key, invocation));
}

Words ProgramsOf(const EvaluateOnBusOptions&) { return ProgramsToJoin("evaluate on-bus"); }

int Run(const EvaluateOnBusOptions& options, const Invocation& invocation) {
  const cli::BusOptions& place = options.episode.bus;
  const std::string bus = BusOf(place.bus);
  RequireRoute(bus);
  return Become(Joining(bus, place.key, invocation));
}

Words ProgramsOf(const PredictOptions&) { return ProgramsToJoin("predict"); }

int Run(const PredictOptions& options, const Invocation& invocation) {
  const std::string bus = BusOf(options.bus.bus);
  RequireRoute(bus);
  return Become(Joining(bus, options.bus.key, invocation));
}

}  // namespace prospect::cli

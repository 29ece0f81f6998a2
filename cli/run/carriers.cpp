#include "cli/run/carriers.h"

#include <map>

namespace prospect::cli {
namespace {

template <typename Options>
Carrier Carried() {
  return {[](const void* options) { return ProgramsOf(*static_cast<const Options*>(options)); },
          [](const void* options, const Invocation& invocation) {
            return Run(*static_cast<const Options*>(options), invocation);
          }};
}

// Needs no program of ours.
template <typename Options>
Carrier CarriedAlone() {
  return {[](const void*) { return Words{}; },
          [](const void* options, const Invocation&) {
            return Run(*static_cast<const Options*>(options));
          }};
}

Carrier Plain(int (*run)(), const Words& programs = {}) {
  return {[programs](const void*) { return programs; },
          [run](const void*, const Invocation&) { return run(); }};
}

const std::map<std::string, Carrier>& Carriers() {
  static const std::map<std::string, Carrier> carriers{
      {"demo", Carried<DemoOptions>()},
      {"explain", Carried<ExplainOptions>()},
      {"up", Carried<UpOptions>()},
      {"run", Carried<RunOptions>()},
      {"scale", Carried<ScaleOptions>()},
      {"down", Carried<DownOptions>()},
      {"key", Carried<KeyOptions>()},
      {"tasks", CarriedAlone<TasksOptions>()},
      {"task learn", Carried<TaskLearnOptions>()},
      {"check-robot", Carried<CheckRobotOptions>()},
      {"evaluate on-bus", Carried<EvaluateOnBusOptions>()},
      {"doctor", CarriedAlone<DoctorOptions>()},
      {"console", Carried<ConsoleOptions>()},
      {"status", Carried<StatusOptions>()},
      {"spy", Carried<SpyOptions>()},
      {"record", CarriedAlone<RecordOptions>()},
      {"predict", Carried<PredictOptions>()},
      {"merge", Carried<MergeOptions>()},
      {"bench search", Carried<BenchSearchOptions>()},
      {"messages", Plain(TellMessages, {"schema_gen"})},
      {"version", Plain(TellVersion)},
      {"completion", Plain(TellCompletion)},
  };
  return carriers;
}

}  // namespace

const Carrier* FindCarrier(const std::string& command) {
  const auto found = Carriers().find(command);
  return found == Carriers().end() ? nullptr : &found->second;
}

}  // namespace prospect::cli

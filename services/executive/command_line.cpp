#include "services/executive/command_line.h"

#include "cli/command.h"
#include "cli/commands/executive.h"
#include "cli/values.h"

namespace prospect::services {
namespace {

constexpr char kTuning[] = "For programs and measurements";

void AddSearchOptions(CLI::App& app, ExecutiveOptions& options) {
  auto& search = options.search;
  app.add_option("--c", search.c, "exploration constant of the paper's rule")
      ->check(cli::Real(1e-9, 1e9))
      ->capture_default_str()
      ->group(kTuning);
  app.add_option("--c-done", search.c_done, "f below it: the action failed")
      ->check(cli::Real(0, 1))
      ->capture_default_str()
      ->group(kTuning);
  app.add_option("--v-failed", search.v_failed, "V below it: not followed further")
      ->check(cli::Real(0, 1))
      ->capture_default_str()
      ->group(kTuning);
  app.add_option("--p-min", search.p_min, "p below it: the action cannot follow")
      ->check(cli::Real(0, 1))
      ->capture_default_str()
      ->group(kTuning);
  app.add_option("--search-seed", search.seed, "breaks ties")
      ->capture_default_str()
      ->group(kTuning);
  app.add_option("--leaves", options.leaves, "evaluations a worker may have in flight")
      ->transform(cli::Whole(1, 256))
      ->capture_default_str()
      ->group(kTuning);
  app.add_option("--budget-ms", options.budget_ms, "time for one search; -1: none")
      ->transform(cli::Whole(-1, 86'400'000))
      ->capture_default_str()
      ->group(kTuning);
}

void AddServiceOptions(CLI::App& app, ExecutiveOptions& options) {
  app.add_option("--weights-hash", options.weights_hash,
                 "16 hexadecimal digits; empty: what the first server holds")
      ->group(kTuning);
  app.add_option("--services-timeout-ms", options.services_timeout_ms,
                 "how long to wait for services")
      ->transform(cli::Whole(0, 3'600'000))
      ->capture_default_str()
      ->group(kTuning);
  app.add_option("--scene-timeout-ms", options.scene_timeout_ms,
                 "ms to wait for the scene to stand before the camera")
      ->transform(cli::Whole(0, 3'600'000))
      ->capture_default_str()
      ->group(kTuning);
}

// What a person asked for, into what the episode takes.
void Take(const cli::ExecutiveOptions& given, ExecutiveCall* call) {
  ExecutiveOptions& options = call->options;
  Take(given.episode, &options);
  options.reset = given.reset;
  options.ask = given.ask;
  options.world = given.world;
  options.policy = given.acting.policy;
  options.retries = given.acting.retries;
  if (given.acting.surprise) options.surprise = *given.acting.surprise;
  options.explain_only = given.explain_only;
  options.what_if = given.what_if;
  call->episodes = given.trials.episodes;
  call->pause = given.trials.pause;
  call->common = CommonOptions(given.episode.bus);
  call->report = given.episode.report;
}

}  // namespace

std::optional<int> ParseExecutive(int argc, char** argv, ExecutiveCall* call) {
  CLI::App app;
  cli::SetUp(app, "prospect-executive");
  app.description("one episode against services that are up");
  cli::ExecutiveOptions given;
  given.episode.bus.log_level = "warn";  // people want the progress and the table
  cli::Define(app, given);
  AddSearchOptions(app, call->options);
  AddServiceOptions(app, call->options);
  const auto end = cli::ParseArguments(app, std::vector<std::string>(argv + 1, argv + argc),
                                       [&] { return Defect(given); });
  if (end) return end;
  if (given.episode.verbose && app.count("--log-level") == 0) given.episode.bus.log_level = "info";
  Take(given, call);
  return std::nullopt;
}

}  // namespace prospect::services

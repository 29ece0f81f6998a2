// prospect-collect: records random trials of a task as a data set. May be killed at any time;
// --resume goes on.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "model/dataset.h"
#include "tools/collect/collector.h"
#include "tools/common/causes.h"
#include "tools/common/json_file.h"

namespace {

using nlohmann::json;
using namespace prospect;

void AddOptions(CLI::App* app, tools::CollectOptions* options, std::string* json_file) {
  app->add_option("--task", options->task, "The task")->capture_default_str();
  app->add_option("--trials", options->trials, "Number of trials")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app->add_option("--seed", options->seed,
                  "Seed of the first trial; trial i has seed + i (0 to 999,999)")
      ->capture_default_str();
  app->add_option("--out", options->out, "The data set to write (HDF5)")->required();
  app->add_option("--jobs", options->jobs, "Processes")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app->add_option("--objects", options->objects, "Objects on the site: 4 to 7, or mixed")
      ->capture_default_str();
  app->add_option("--legs", options->legs, "Objects to investigate in a row: 3 to 5, or mixed")
      ->capture_default_str();
  app->add_option("--tower", options->tower, "Stacking: blocks in the tower, 2 to 4")
      ->capture_default_str();
  app->add_option("--scene-file", options->scene_file,
                  "Stacking: a file like config/scenes/stacking.yaml");
  app->add_option("--image-noise", options->image_noise,
                  "Sigma of the sensor noise that readers add, a share of full range")
      ->check(CLI::Range(0.0, 0.25))
      ->capture_default_str();
  app->add_flag("--resume", options->resume, "Go on with the trials that an earlier run left");
  app->add_flag("--keep-parts", options->keep_parts, "Keep the files of single trials");
  app->add_option("--json", *json_file, "Write the figures to this file, too");
}

// Keys: task, trials, kept, successes, failures (by cause), reasons, frames, simulated_seconds,
// wall_seconds, out.
json Report(const tools::CollectOptions& options, const tools::CollectSummary& summary) {
  return {{"task", options.task},
          {"trials", summary.trials},
          {"kept", summary.kept},
          {"successes", summary.successes},
          {"failures", tools::ByCause(summary.failures)},
          {"reasons", summary.failures},
          {"frames", summary.frames},
          {"simulated_seconds", summary.simulated_seconds},
          {"wall_seconds", summary.wall_seconds},
          {"out", options.out}};
}

void Print(const tools::CollectOptions& options, const tools::CollectSummary& summary) {
  std::printf("%d trials (%d kept from before), %lld frames in %s\n", summary.trials, summary.kept,
              static_cast<long long>(summary.frames), options.out.c_str());
  std::printf("successes  %d (%.1f %%)\n", summary.successes,
              100.0 * summary.successes / summary.trials);
  tools::PrintCauses(summary.failures, summary.trials, stdout);
  std::printf("%.0f s simulated in %.1f s\n", summary.simulated_seconds, summary.wall_seconds);
}

int Run(const tools::CollectOptions& options, const std::string& json_file) {
  const tools::CollectSummary summary = tools::Collect(options);
  Print(options, summary);
  if (!json_file.empty()) tools::WriteJsonFile(json_file, Report(options, summary));
  return 0;
}

int Refuse(const std::exception& error, int code) {
  std::cerr << "prospect-collect: " << error.what() << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Record random trials of a task as a data set");
  tools::CollectOptions options;
  std::string json_file;
  AddOptions(&app, &options, &json_file);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return Run(options, json_file);
  } catch (const tools::CollectUsageError& error) {
    return Refuse(error, 2);
  } catch (const model::DataError& error) {
    return Refuse(error, 14);
  } catch (const std::exception& error) {
    return Refuse(error, 13);
  }
}

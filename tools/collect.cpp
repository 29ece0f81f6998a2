// prospect-collect: records random trials of a task as a data set. May be killed at any time;
// --resume goes on.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/json_file.h"
#include "model/dataset.h"
#include "tools/collect/collector.h"
#include "tools/collect/gesture_videos.h"
#include "tools/common/causes.h"
#include "tools/common/program.h"

namespace {

using nlohmann::json;
using namespace prospect;

struct Options {
  tools::CollectOptions collect;
  tools::GestureVideoOptions videos;
  std::string format = "hdf5";
  std::string json_file;
};

void AddSceneOptions(CLI::App* app, tools::CollectOptions* options) {
  app->add_option("--objects", options->objects, "Objects on the site: 4 to 7, or mixed")
      ->capture_default_str();
  app->add_option("--legs", options->legs, "Objects to investigate in a row: 3 to 5, or mixed")
      ->capture_default_str();
  app->add_option("--tower", options->tower, "Stacking: blocks in the tower, 2 to 4")
      ->check(CLI::Range(2, 4))
      ->capture_default_str();
  app->add_option("--scene-file", options->scene_file,
                  "Stacking: a file like config/scenes/stacking.yaml")
      ->check(CLI::ExistingFile);
}

// Trials as videos: report/ writes them, and a build for machines that only train lacks it.
#ifdef PROSPECT_VIDEOS
const std::vector<std::string> kFormats = {"hdf5", "jigsaws"};

void AddVideoOptions(CLI::App* app, tools::GestureVideoOptions* options) {
  app->add_option("--fps", options->frames_per_second,
                  "jigsaws: frames a second, a divisor of 30 (JIGSAWS has 30)")
      ->check(CLI::Range(1, 30))
      ->capture_default_str();
  app->add_option("--width", options->width, "jigsaws: pixels (JIGSAWS has 640)")
      ->check(CLI::Range(32, 1920))
      ->capture_default_str();
  app->add_option("--height", options->height, "jigsaws: pixels (JIGSAWS has 480)")
      ->check(CLI::Range(24, 1080))
      ->capture_default_str();
  app->add_flag("--right-eye", options->right_eye, "jigsaws: write NAME_capture2.avi, too");
  app->add_flag("--failures", options->failures,
                "jigsaws: keep trials that fail; otherwise they are done again until they succeed, "
                "as JIGSAWS has none");
}

int RunVideos(const CLI::App& app, const Options& all) {
  const tools::CollectOptions& options = all.collect;
  if (options.task != "suturing") {
    throw tools::CollectUsageError("--format jigsaws is for --task suturing");
  }
  tools::GestureVideoOptions videos = all.videos;
  if (app.count("--trials") > 0) videos.trials = options.trials;
  videos.seed = options.seed;
  videos.out = options.out;
  videos.image_noise = options.image_noise;
  videos.jobs = options.jobs;
  videos.resume = options.resume;
  const tools::GestureVideoSummary summary = tools::CollectGestureVideos(videos);
  const std::string done = videos.failures ? "failed" : "failed and were done again";
  int failed = 0;
  for (const auto& [reason, count] : summary.failures) failed += count;
  std::printf("%d SIMULATED trials (%d kept from before), %lld frames in %s/Suturing\n",
              summary.trials, summary.kept, static_cast<long long>(summary.frames),
              videos.out.c_str());
  std::printf("%d trials %s\n", failed, done.c_str());
  tools::PrintCauses(summary.failures, summary.trials, stdout);
  std::printf("%.0f s of video in %.1f s\n", summary.simulated_seconds, summary.wall_seconds);
  if (all.json_file.empty()) return 0;
  base::WriteJsonFile(all.json_file, {{"task", options.task},
                                      {"trials", summary.trials},
                                      {"kept", summary.kept},
                                      {"reasons", summary.failures},
                                      {"frames", summary.frames},
                                      {"simulated_seconds", summary.simulated_seconds},
                                      {"wall_seconds", summary.wall_seconds},
                                      {"out", videos.out}});
  return 0;
}
#else
const std::vector<std::string> kFormats = {"hdf5"};
#endif

void AddOptions(CLI::App* app, Options* all) {
  tools::CollectOptions* options = &all->collect;
  app->add_option("--task", options->task, "The task")->capture_default_str();
  app->add_option("--format", all->format,
                  "hdf5: a data set; jigsaws: SIMULATED suturing videos and transcriptions in the "
                  "layout of JIGSAWS")
      ->check(CLI::IsMember(kFormats))
      ->capture_default_str();
  app->add_option("--trials", options->trials, "Number of trials (jigsaws: 1 to 39, default 39)")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app->add_option("--seed", options->seed,
                  "Seed of the first trial; trial i has seed + i (0 to 999,999)")
      ->capture_default_str();
  app->add_option("--out", options->out, "The data set to write (HDF5); jigsaws: a folder")
      ->required();
  app->add_option("--jobs", options->jobs, "Processes")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  AddSceneOptions(app, options);
  app->add_option("--image-noise", options->image_noise,
                  "Sigma of the sensor noise that readers add (jigsaws: that is in the pictures), "
                  "a share of full range")
      ->check(CLI::Range(0.0, 0.25))
      ->capture_default_str();
#ifdef PROSPECT_VIDEOS
  AddVideoOptions(app, &all->videos);
#endif
  app->add_flag("--resume", options->resume, "Go on with the trials that an earlier run left");
  app->add_flag("--keep-parts", options->keep_parts, "Keep the files of single trials");
  app->add_option("--json", all->json_file, "Write the figures to this file, too");
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
  if (!json_file.empty()) base::WriteJsonFile(json_file, Report(options, summary));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Record random trials of a task as a data set");
  Options options;
  AddOptions(&app, &options);
  return tools::RunProgram("prospect-collect", &app, argc, argv, [&] {
#ifdef PROSPECT_VIDEOS
    if (options.format == "jigsaws") return RunVideos(app, options);
#endif
    return Run(options.collect, options.json_file);
  });
}

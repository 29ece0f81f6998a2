// prospect-view: a picture of a task's scene, at any size and from any of its cameras, for people.
// With --actions, after these actions; with --frames or --video, of every tick on the way. With
// --episode the scene and the actions are those of an episode that was carried out: worlds repeat
// bit for bit, so what is shown is what happened.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "report/people_view.h"
#include "report/png.h"
#include "report/video_writer.h"
#include "sim/rollout.h"
#include "sim/task_factory.h"
#include "tools/common/program.h"
#include "tools/common/progress.h"
#include "tools/common/scene_options.h"
#include "tools/view/episode_file.h"

namespace {

using namespace prospect;

struct Options {
  std::string task = "navigation";
  std::uint64_t seed = 2'000'000;
  sim::TaskOptions world;
  std::string out;
  std::string frames;
  std::string video;
  std::string episode;
  std::string world_version;  // the episode's; empty: any
  std::string size = "640x480";
  std::string camera;
  std::vector<int> actions;
  int width = 0;
  int height = 0;
};

void AddOptions(CLI::App* app, Options* options) {
  app->add_option("--task", options->task, "The task")->capture_default_str();
  app->add_option("--seed", options->seed, "The scene")->capture_default_str();
  app->add_option("--out", options->out, "The picture to write (PNG)");
  app->add_option("--size", options->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  app->add_option("--camera", options->camera,
                  "One of the scene's cameras (default: view, or the only one)");
  app->add_option("--actions", options->actions, "Carry these actions out first: 0,4,8")
      ->delimiter(',');
  app->add_option("--frames", options->frames,
                  "A folder for a picture of every tick, 00000.png and so on");
  app->add_option("--video", options->video, "A video of every tick to write (MP4)");
  app->add_option("--episode", options->episode,
                  "An episode's result.json: task, scene and actions are taken from there");
  tools::AddSceneOptions(app, &options->world);
}

void ReadEpisode(Options* options) {
  if (options->episode.empty()) return;
  const tools::CarriedOut episode = tools::ReadEpisodeResult(options->episode);
  options->task = episode.task;
  options->seed = episode.seed;
  options->actions = episode.actions;
  options->world_version = episode.world_version;
  if (episode.task == "navigation") options->world.objects = episode.objects;
  sim::SetPlanLength(episode.task, episode.plan_length, &options->world);
}

void ReadSize(Options* options) {
  char end = 0;
  const int read =
      std::sscanf(options->size.c_str(), "%dx%d%c", &options->width, &options->height, &end);
  if (read != 2) {
    throw std::invalid_argument("--size is '" + options->size + "': give WIDTHxHEIGHT");
  }
}

sim::Image Take(sim::Task& task, const Options& options) {
  return report::PeoplesView(task, options.camera, options.width, options.height);
}

// A picture of every tick, as numbered files and as a video.
class FrameWriter : public sim::FrameSink {
 public:
  FrameWriter(sim::Task* task, const Options& options) : task_(task), options_(options) {
    if (!options.frames.empty()) std::filesystem::create_directories(options.frames);
    const int actions = static_cast<int>(options.actions.size());
    if (actions > 0) bar_ = std::make_unique<tools::Progress>("actions shown", actions);
    if (options.video.empty()) return;
    video_ = std::make_unique<report::VideoWriter>(options.video, 1 / task->spec().tick_seconds,
                                                   options.width, options.height);
  }

  void OnFrame(const sim::Image&, const sim::Progress& progress) override {
    const sim::Image picture = Take(*task_, options_);
    const bool under_way = progress.action_state == sim::ActionState::kRunning ||
                           progress.action_state == sim::ActionState::kIdle;
    if (bar_ && !under_way) bar_->Step();
    if (video_) video_->Add(picture);
    if (options_.frames.empty()) return;
    char name[32];
    std::snprintf(name, sizeof name, "/%05d.png", count_++);
    report::WritePng(options_.frames + name, picture);
  }

  void Finish() {
    bar_.reset();
    if (video_) video_->Finish();
  }

 private:
  sim::Task* task_;
  const Options& options_;
  std::unique_ptr<report::VideoWriter> video_;
  std::unique_ptr<tools::Progress> bar_;
  int count_ = 0;
};

void RequireOutput(const Options& options) {
  if (options.out.empty() && options.frames.empty() && options.video.empty()) {
    throw std::invalid_argument("nothing to write: give --out, --frames or --video");
  }
}

// What is shown is what happened only in the world in which it did.
void RequireWorld(const sim::Task& task, const std::string& wanted) {
  if (wanted.empty() || wanted == task.spec().world_version) return;
  throw std::invalid_argument("this episode was carried out in the world " + wanted +
                              ", and this is " + task.spec().world_version +
                              ": give its --scene-file");
}

int Run(const Options& options) {
  const auto task = sim::MakeTask(options.task, options.world);
  RequireWorld(*task, options.world_version);
  task->Reset(options.seed);
  const bool every_tick = !options.frames.empty() || !options.video.empty();
  std::unique_ptr<FrameWriter> writer;
  if (every_tick) writer = std::make_unique<FrameWriter>(task.get(), options);
  const auto result = sim::RunPlan(*task, options.actions, writer.get());
  if (writer) writer->Finish();
  if (result.reason == "illegal_action") {
    throw std::invalid_argument("--actions: action " +
                                std::to_string(options.actions[result.actions_done]) +
                                " may not follow there");
  }
  if (!options.out.empty()) report::WritePng(options.out, Take(*task, options));
  const sim::Progress progress = task->progress();
  std::printf("%s, scene %llu, %.1f s: %s %s\n", options.task.c_str(),
              static_cast<unsigned long long>(options.seed), progress.time,
              ToString(progress.outcome), progress.reason.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A picture of a task's scene, for people");
  Options options;
  AddOptions(&app, &options);
  return tools::RunProgram("prospect-view", &app, argc, argv, [&] {
    RequireOutput(options);
    ReadSize(&options);
    ReadEpisode(&options);
    return Run(options);
  });
}

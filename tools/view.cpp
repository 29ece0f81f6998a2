// prospect-view: a picture of a task's scene, at any size and from any of its cameras, for people.
// With --actions, after these actions; with --frames, of every tick on the way.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/png.h"
#include "sim/rollout.h"
#include "sim/stacking/stacking_task.h"
#include "sim/task_factory.h"

namespace {

using namespace prospect;

struct Options {
  std::string task = "navigation";
  std::uint64_t seed = 2'000'000;
  sim::TaskOptions world;
  std::string out;
  std::string frames;
  std::string size = "640x480";
  std::string camera;
  std::vector<int> actions;
  int width = 0;
  int height = 0;
};

void AddOptions(CLI::App* app, Options* options) {
  app->add_option("--task", options->task, "The task")->capture_default_str();
  app->add_option("--seed", options->seed, "The scene")->capture_default_str();
  app->add_option("--out", options->out, "The picture to write (PNG)")->required();
  app->add_option("--size", options->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  app->add_option("--camera", options->camera,
                  "One of the scene's cameras (default: view, or the only one)");
  app->add_option("--actions", options->actions, "Carry these actions out first: 0,4,8")
      ->delimiter(',');
  app->add_option("--frames", options->frames,
                  "A folder for a picture of every tick, 00000.png and so on");
  app->add_option("--scene-file", options->world.scene_file,
                  "Stacking: a file like config/scenes/stacking.yaml");
  app->add_option("--tower", options->world.tower, "Stacking: blocks in the tower, 2 to 4")
      ->capture_default_str();
  app->add_option("--objects", options->world.objects, "Navigation: objects on the site, 4 to 7")
      ->capture_default_str();
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
  auto* stacking = dynamic_cast<sim::StackingTask*>(&task);
  if (stacking != nullptr) {
    const std::string camera = options.camera.empty() ? "view" : options.camera;
    return stacking->RenderFrom(camera, options.width, options.height);
  }
  if (!options.camera.empty()) {
    throw std::invalid_argument("task '" + options.task + "' has one camera: leave --camera out");
  }
  return task.Render(options.width, options.height);
}

// A numbered picture of every tick.
class FrameWriter : public sim::FrameSink {
 public:
  FrameWriter(sim::Task* task, const Options& options) : task_(task), options_(options) {}

  void OnFrame(const sim::Image&, const sim::Progress&) override {
    char name[32];
    std::snprintf(name, sizeof name, "/%05d.png", count_++);
    sim::WritePng(options_.frames + name, Take(*task_, options_));
  }

 private:
  sim::Task* task_;
  const Options& options_;
  int count_ = 0;
};

int Run(const Options& options) {
  const auto task = sim::MakeTask(options.task, options.world);
  task->Reset(options.seed);
  FrameWriter writer(task.get(), options);
  if (!options.frames.empty()) std::filesystem::create_directories(options.frames);
  const auto result =
      sim::RunPlan(*task, options.actions, options.frames.empty() ? nullptr : &writer);
  if (result.reason == "illegal_action") {
    throw std::invalid_argument("--actions: action " +
                                std::to_string(options.actions[result.actions_done]) +
                                " may not follow there");
  }
  sim::WritePng(options.out, Take(*task, options));
  const sim::Progress progress = task->progress();
  std::printf("%s, scene %llu, %.1f s: %s %s\n", options.out.c_str(),
              static_cast<unsigned long long>(options.seed), progress.time,
              ToString(progress.outcome), progress.reason.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A picture of a task's scene, for people");
  Options options;
  AddOptions(&app, &options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    ReadSize(&options);
    return Run(options);
  } catch (const std::invalid_argument& error) {
    std::cerr << "prospect-view: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "prospect-view: " << error.what() << '\n';
    return 13;
  }
}

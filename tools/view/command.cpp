#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/quiet.h"
#include "cli/options/task.h"
#include "report/people_view.h"
#include "report/png.h"
#include "report/video_writer.h"
#include "sim/rollout.h"
#include "sim/task_factory.h"
#include "tools/common/progress.h"
#include "tools/common/world.h"
#include "tools/view/episode_file.h"
#include "tools/world/commands.h"

namespace prospect::tools {
namespace {

// What is shown: the options with what an episode's file says in their place.
struct Shown {
  cli::ViewOptions options;
  sim::TaskOptions world;
  std::string world_version;  // the episode's; empty: any
  int width = 0, height = 0;
};

Shown ShownBy(const cli::ViewOptions& options) {
  Shown shown{options, WorldOf(options.scene), "", 0, 0};
  std::sscanf(options.size.c_str(), "%dx%d", &shown.width, &shown.height);  // checked before
  if (options.episode.empty()) return shown;
  const CarriedOut episode = ReadEpisodeResult(options.episode);
  shown.options.task = episode.task;
  shown.options.seed = episode.seed;
  shown.options.actions = episode.actions;
  shown.world_version = episode.world_version;
  const auto& simulator = cli::TaskOf(episode.task).simulator;
  if (simulator && simulator->scene.count("objects")) shown.world.objects = episode.objects;
  sim::SetPlanLength(episode.task, episode.plan_length, &shown.world);
  return shown;
}

sim::Image Take(sim::Task& task, const Shown& shown) {
  return report::PeoplesView(task, shown.options.camera, shown.width, shown.height);
}

// A picture of every tick, as numbered files and as a video.
class FrameWriter : public sim::FrameSink {
 public:
  FrameWriter(sim::Task* task, const Shown& shown) : task_(task), shown_(shown) {
    if (!shown.options.frames.empty()) std::filesystem::create_directories(shown.options.frames);
    const int actions = static_cast<int>(shown.options.actions.size());
    if (actions > 0) bar_ = std::make_unique<Progress>("actions shown", actions);
    if (shown.options.video.empty()) return;
    video_ = std::make_unique<report::VideoWriter>(
        shown.options.video, 1 / task->spec().tick_seconds, shown.width, shown.height);
  }

  void OnFrame(const sim::Image&, const sim::Progress& progress) override {
    const sim::Image picture = Take(*task_, shown_);
    const bool under_way = progress.action_state == sim::ActionState::kRunning ||
                           progress.action_state == sim::ActionState::kIdle;
    if (bar_ && !under_way) bar_->Step();
    if (video_) video_->Add(picture);
    if (shown_.options.frames.empty()) return;
    char name[32];
    std::snprintf(name, sizeof name, "/%05d.png", count_++);
    report::WritePng(shown_.options.frames + name, picture);
  }

  void Finish() {
    bar_.reset();
    if (video_) video_->Finish();
  }

 private:
  sim::Task* task_;
  const Shown& shown_;
  std::unique_ptr<report::VideoWriter> video_;
  std::unique_ptr<Progress> bar_;
  int count_ = 0;
};

// What is shown is what happened only in the world in which it did.
void RequireWorld(const sim::Task& task, const std::string& wanted) {
  if (wanted.empty() || wanted == task.spec().world_version) return;
  throw std::invalid_argument("this episode was carried out in the world " + wanted +
                              ", and this is " + task.spec().world_version +
                              ": give its --scene-file");
}

void Tell(const Shown& shown, const sim::Progress& progress) {
  if (base::Quiet()) return;
  std::printf("%s, scene %llu, %.1f s: %s %s\n", shown.options.task.c_str(),
              static_cast<unsigned long long>(shown.options.seed), progress.time,
              ToString(progress.outcome), progress.reason.c_str());
}

int Show(const Shown& shown) {
  const cli::ViewOptions& options = shown.options;
  const auto task = sim::MakeTask(options.task, shown.world);
  RequireWorld(*task, shown.world_version);
  task->Reset(options.seed);
  const bool every_tick = !options.frames.empty() || !options.video.empty();
  std::unique_ptr<FrameWriter> writer;
  if (every_tick) writer = std::make_unique<FrameWriter>(task.get(), shown);
  const auto result = sim::RunPlan(*task, options.actions, writer.get());
  if (writer) writer->Finish();
  if (result.reason == "illegal_action") {
    throw std::invalid_argument("--actions: action " +
                                std::to_string(options.actions[result.actions_done]) +
                                " may not follow there");
  }
  if (!options.out.empty()) report::WritePng(options.out, Take(*task, shown));
  Tell(shown, task->progress());
  return 0;
}

}  // namespace

int RunView(const cli::ViewOptions& options) { return Show(ShownBy(options)); }

}  // namespace prospect::tools

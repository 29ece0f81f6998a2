#include "tools/evaluate/scene_video.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "sim/rollout.h"
#include "tools/view/people_view.h"
#include "tools/view/video.h"

namespace prospect::tools {
namespace {

constexpr int kWidth = 640, kHeight = 480;

class Filmed : public sim::FrameSink {
 public:
  Filmed(sim::Task* task, const std::string& path)
      : task_(task),
        still_(static_cast<int>(std::lround(1 / task->spec().tick_seconds))),
        video_(path, 1 / task->spec().tick_seconds, kWidth, kHeight) {}

  void OnFrame(const sim::Image&, const sim::Progress&) override { Add(1); }
  void Pause() { Add(still_); }
  void Finish() { video_.Finish(); }

 private:
  void Add(int times) {
    const sim::Image picture = PeoplesView(*task_, "", kWidth, kHeight);
    for (int i = 0; i < times; ++i) video_.Add(picture);
  }

  sim::Task* task_;
  int still_;
  Video video_;
};

bool Repeats(const sim::RolloutResult& result, const EpisodeRecord& episode) {
  if (episode.ending == Ending::kSolved) return result.outcome == sim::Outcome::kSuccess;
  if (result.reason == "illegal_action") return episode.ending == Ending::kFailed;
  if (episode.ending == Ending::kFailed) return result.outcome != sim::Outcome::kRunning;
  return result.outcome == sim::Outcome::kRunning;
}

}  // namespace

std::string WriteSceneVideo(sim::Task& task, std::uint64_t seed, const EpisodeRecord& episode,
                            const std::string& folder) {
  std::filesystem::create_directories(folder);
  const std::string path =
      folder + "/" + std::to_string(seed) + "-" + ToString(episode.ending) + ".mp4";
  task.Reset(seed);
  Filmed filmed(&task, path);
  filmed.Pause();
  const sim::RolloutResult result = sim::RunPlan(task, episode.actions, &filmed);
  filmed.Pause();
  filmed.Finish();
  if (!Repeats(result, episode)) {
    throw std::logic_error("scene " + std::to_string(seed) +
                           " did not repeat: " + ToString(episode.ending) + " before, " +
                           ToString(result.outcome) + " in the video");
  }
  return path;
}

}  // namespace prospect::tools

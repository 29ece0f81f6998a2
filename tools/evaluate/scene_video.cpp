#include "tools/evaluate/scene_video.h"

#include <filesystem>
#include <stdexcept>

#include "report/plan_film.h"

namespace prospect::tools {
namespace {

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
  const sim::RolloutResult result = report::FilmPlan(task, seed, episode.actions, path);
  if (!Repeats(result, episode)) {
    throw std::logic_error("scene " + std::to_string(seed) +
                           " did not repeat: " + ToString(episode.ending) + " before, " +
                           ToString(result.outcome) + " in the video");
  }
  return path;
}

}  // namespace prospect::tools
